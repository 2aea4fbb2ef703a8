# SPDX-License-Identifier: MIT
"""Commands that cannot be done: one line, exit 2, nothing touched."""
import os
import unittest

from program import SLOT, ProgramTest

SWEPT = SLOT + '[sweep.axes]\n"cut.feed_rate_mm_per_min" = [600.0, 1740.0]\n'


class BadCommands(ProgramTest):
    def setUp(self):
        super().setUp()
        self.write(SLOT)
        self.write(SWEPT, "swept.toml")

    def check(self, arguments, *lines):
        before = self.files()
        self.assertEqual(self.refused(*arguments).splitlines(), list(lines))
        self.assertEqual(self.files(), before)

    def test_verbs_and_flags(self):
        self.check([], "millstudy: give one of plan, run, status, merge, fit, sensitivity, export, keys; see millstudy --help")
        self.check(["mill", "study.toml"],
                   "millstudy: mill is not one of plan, run, status, merge, fit, sensitivity, export, keys; see millstudy --help")
        self.check(["run"], "millstudy run: study is required; see millstudy run --help")
        self.check(["run", "study.toml", "--turbo"], "millstudy run: The following argument was not "
                   "expected: --turbo; see millstudy run --help")
        self.check(["run", "study.toml", "--threads", "0"], "millstudy run: --threads: Value 0 not "
                   "in range 1 to 1024; see millstudy run --help")
        self.check(["run", "study.toml", "--threads", "two"], "millstudy run: --threads: Value two "
                   "not in range 1 to 1024; see millstudy run --help")
        self.check(["run", "study.toml", "--block-size", "0"], "millstudy run: --block-size: Value 0 "
                   "not in range 1 to 1000000; see millstudy run --help")
        self.check(["keys", "turning"],
                   'there is no kind "turning": one of path, force, path_force, stability, finish, fit')

    def test_set(self):
        run = ["run", "study.toml", "--set"]
        self.check([*run, "cut.axial_depth_mm"], "--set cut.axial_depth_mm: must be key=value")
        self.check([*run, "=3"], "--set =3: must be key=value")
        self.check([*run, "cut depth=3"], '--set cut depth=3: "cut depth" is not a dotted key such as '
                   "cut.axial_depth_mm")
        self.check([*run, "cut.axial_depth_mm=-1"],
                   "--set cut.axial_depth_mm=-1: cut.axial_depth_mm = -1 mm must be > 0")
        self.check([*run, "cut.axial_depth_mm=deep"],
                   "--set cut.axial_depth_mm=deep: cut.axial_depth_mm must be a number, not a string")
        self.check([*run, "cut.axial_dept_mm=1"], "--set cut.axial_dept_mm=1: cut.axial_dept_mm is "
                   "not a key of kind force; did you mean cut.axial_depth_mm?")
        self.check([*run, "cut.milling=sideways"], "--set cut.milling=sideways: cut.milling = "
                   '"sideways" must be one of slot, up, down')
        self.check(["run", "swept.toml", "--set", "cut.feed_rate_mm_per_min=900"],
                   "--set cut.feed_rate_mm_per_min=900: cut.feed_rate_mm_per_min is an axis of the "
                   "sweep; set the axis instead: --set 'sweep.axes.\"cut.feed_rate_mm_per_min\"=[...]'")

    def test_every_fault_of_several_sets(self):
        self.check(["run", "study.toml", "--set", "cutter.flutes=0", "--set", "cut.exit_deg=200"],
                   "--set cutter.flutes=0: cutter.flutes = 0 must be >= 1",
                   "--set cut.exit_deg=200: cut.exit_deg = 200 deg must be <= 180",
                   "--set cut.exit_deg=200: cut.entry_deg and cut.exit_deg contradict cut.milling: "
                   "give one or the other")

    def test_output_that_cannot_be_written(self):
        run = ["run", "study.toml", "-o"]
        (self.folder / "folder").mkdir()
        self.write("my notes\n", "notes.txt")
        self.check([*run, "nowhere/r.h5"],
                   "nowhere/r.h5: cannot be written: folder nowhere: No such file or directory")
        self.check([*run, "notes.txt/r.h5"],
                   "notes.txt/r.h5: cannot be written: notes.txt is not a folder")
        self.check([*run, "folder"], "folder: is not a regular file")
        self.check([*run, "study.toml"],
                   "study.toml: is the study itself: give another result file with -o")
        self.check([*run, "study.toml", "--fresh"],
                   "study.toml: is the study itself: give another result file with -o")

    def test_a_file_that_is_no_result_is_never_overwritten(self):
        self.write("my notes\n", "notes.h5")
        before = self.files()
        said = self.refused("run", "study.toml", "-o", "notes.h5")
        self.assertRegex(said, r"\Anotes\.h5: is no readable result file[^\n]*\n\Z")
        self.assertEqual(self.files(), before)

    @unittest.skipIf(os.geteuid() == 0, "root writes everywhere")
    def test_folder_without_permission(self):
        (self.folder / "locked").mkdir(mode=0o555)
        self.check(["run", "study.toml", "-o", "locked/r.h5"],
                   "locked/r.h5: cannot be written: Permission denied")

    def test_export(self):
        self.write("my notes\n", "notes.h5")
        for arguments in (["notes.h5", "-o", "t.csv"], ["nowhere.h5", "-o", "t.csv"],
                          ["study.toml", "-o", "t.npy"]):
            before = self.files()
            self.assertRegex(self.refused("export", *arguments), r"\A[^\n]+: is no [^\n]+\n\Z")
            self.assertEqual(self.files(), before)
        self.millstudy("run", "study.toml")
        self.check(["export", "slot.h5", "-o", "t.xls"],
                   "t.xls: is of no known kind: tables are written as .csv or .npy")
        self.check(["export", "slot.h5", "-o", "nowhere/t.csv"],
                   "nowhere/t.csv: cannot be written: folder nowhere: No such file or directory")


if __name__ == "__main__":
    unittest.main()
