# SPDX-License-Identifier: MIT
"""The verb sensitivity: Sobol' indices of a result of design saltelli."""
import csv
import json
import unittest

from program import SLOT, ProgramTest

DESIGN = """\
[sweep]
design = "saltelli"
samples = 64
[sweep.axes]
"cut.axial_depth_mm" = { from = 0.4, to = 0.6 }
"cut.feed_rate_mm_per_min" = { from = 1000.0, to = 2000.0 }
"cutter.flutes" = { from = 2, to = 4 }
"""


class Sensitivity(ProgramTest):
    def indices(self, result, *options):
        return json.loads(self.millstudy("sensitivity", result, "--json", *options).stdout)

    def test_gives_indices_of_every_variable_as_text_json_and_table(self):
        self.write(SLOT + DESIGN)
        self.assertIn("320 points, 320 ok", self.millstudy("run", "study.toml").stdout)
        every = self.indices("slot.h5")
        force = next(one for one in every if one["variable"] == "force_resultant_max")
        self.assertEqual((force["groups"], force["dropped_groups"], force["units"]), (64, 0, "N"))
        self.assertEqual([axis["axis"] for axis in force["axes"]],
                         ["cut.axial_depth_mm", "cut.feed_rate_mm_per_min", "cutter.flutes"])
        for axis in force["axes"]:
            self.assertLessEqual(axis["total"]["low"], axis["total"]["value"])
            self.assertLessEqual(axis["total"]["value"], axis["total"]["high"])
        text = self.millstudy("sensitivity", "slot.h5", "--variable", "force_resultant_max", "-o", "T.csv").stdout
        self.assertIn("force_resultant_max: mean", text)
        self.assertNotIn("force_x_max", text)
        with (self.folder / "T.csv").open() as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([float(row["first"]) for row in rows],
                         [axis["first"]["value"] for axis in force["axes"]])

    def test_parts_that_were_merged_have_the_same_indices(self):
        self.write(SLOT + DESIGN)
        self.millstudy("run", "study.toml")
        for part in (1, 2, 3):
            self.millstudy("run", "study.toml", "--shard", f"{part}/3", "-o", f"{part}.h5")
        self.millstudy("merge", "merged.h5", "1.h5", "2.h5", "3.h5")
        self.assertEqual(self.indices("merged.h5"), self.indices("slot.h5"))

    def test_groups_with_a_point_outside_the_limits_are_dropped_and_counted(self):
        self.write(SLOT + DESIGN + '[[sweep.where]]\nquantity = "feed_per_tooth_mm"\nmax = 0.06\n')
        self.millstudy("run", "study.toml")
        force = self.indices("slot.h5", "--variable", "force_resultant_max")[0]
        self.assertGreater(force["dropped_groups"], 0)
        self.assertEqual(force["groups"] + force["dropped_groups"], 64)
        self.assertIn("dropped: not all of their points have a value",
                      self.millstudy("sensitivity", "slot.h5", "--variable", "force_resultant_max").stdout)

    def test_anything_else_is_refused(self):
        self.write(SLOT + '[sweep.axes]\n"cut.axial_depth_mm" = [0.5, 1.0]\n')
        self.millstudy("run", "study.toml")
        self.assertEqual(self.refused("sensitivity", "slot.h5"),
                         "slot.h5: is not of a saltelli design: give the study sweep.design = \"saltelli\" and "
                         "sweep.samples, and run it\n")
        self.refused("sensitivity", "none.h5")
        self.write("no HDF5", "text.h5")
        self.refused("sensitivity", "text.h5")
        self.write(SLOT + DESIGN)
        self.millstudy("run", "study.toml", "-o", "s.h5")
        self.assertEqual(self.refused("sensitivity", "s.h5", "--variable", "force"),
                         "--variable force: the result has no variable of this name\n")


if __name__ == "__main__":
    unittest.main()
