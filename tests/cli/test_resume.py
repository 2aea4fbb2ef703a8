# SPDX-License-Identifier: MIT
"""A run that goes on: after an interruption, after failures, in parts."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import time
import unittest

import h5py
import numpy

from program import PROGRAM, SLOT, SLOW, ProgramTest

AXES = """\
[sweep.axes]
"cut.axial_depth_mm" = { from = 0.1, to = 2.0, count = 40 }
"cut.feed_rate_mm_per_min" = { from = 600.0, to = 3000.0, count = 50 }
"""
# Of one to two seconds on one thread.
STUDY = SLOT.replace("angular_steps = 90", f"angular_steps = {int(60_000 / SLOW)}") + AXES
RADIAL = SLOT.replace('milling = "slot"', 'milling = "up"\nradial_depth_mm = 6.0') + """\
[sweep.axes]
"cut.radial_depth_mm" = [3.0, 6.0, 12.5, 13.0]
"cut.feed_rate_mm_per_min" = { from = 600.0, to = 3000.0, count = 500 }
"""


class ResumeTest(ProgramTest):
    def same(self, a, b):
        """Variables, bit for bit."""
        with h5py.File(self.folder / a) as one, h5py.File(self.folder / b) as other:
            self.assertEqual(list(one), list(other))
            for name, data in one.items():
                if data.shape is None:
                    continue
                if data.dtype.kind in "fi":
                    self.assertEqual(data[()].tobytes(), other[name][()].tobytes(), name)
                else:
                    self.assertEqual(data[()].tolist(), other[name][()].tolist(), name)

    def start(self, *arguments):
        return subprocess.Popen([PROGRAM, "run", "study.toml", *arguments], cwd=self.folder, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def interrupted(self, output, seconds, number, *arguments):
        """Stops a run so many seconds after its journal is there. True if it was not done by then."""
        process = self.start("-o", output, "--quiet", *arguments)
        while process.poll() is None and not (self.folder / f"{output}.journal").exists():
            time.sleep(0.002)
        time.sleep(seconds)
        process.send_signal(number)
        process.communicate(timeout=60)
        return process.returncode not in (0, 3)


class Resume(ResumeTest):
    def test_the_bits_are_those_of_an_uninterrupted_run(self):
        self.write(STUDY)
        self.millstudy("run", "study.toml", "-o", "whole.h5")
        for threads in (1, 2, 7):
            output = f"r{threads}.h5"
            for number in (signal.SIGKILL, signal.SIGINT, signal.SIGKILL):
                self.interrupted(output, 0.1 * SLOW, number, "--threads", str(threads))
            self.millstudy("run", "study.toml", "-o", output, "--threads", threads)
            self.same("whole.h5", output)
        self.assertEqual(sorted(self.files()), ["r1.h5", "r2.h5", "r7.h5", "study.toml", "whole.h5"])

    def test_with_traces_and_failures(self):
        text = RADIAL.replace("count = 500", "count = 40").replace("angular_steps = 90",
                                                                 "angular_steps = 20000")
        self.write(text + "[output]\ntraces = true\n")
        self.millstudy("run", "study.toml", "-o", "whole.h5", code=3)
        self.interrupted("r.h5", 0.1, signal.SIGKILL, "--threads", "1")
        done = self.millstudy("run", "study.toml", "-o", "r.h5", code=3)
        self.assertIn("  80 failed: cut.radial_depth_mm must be <= cutter.diameter_mm\n", done.stdout)
        self.same("whole.h5", "r.h5")

    def test_goes_on_where_it_was(self):
        self.write(STUDY)
        self.assertTrue(self.interrupted("r.h5", 0.3, signal.SIGINT, "--threads", "1"))
        kept = json.loads(self.millstudy("status", "r.h5", "--json").stdout)
        self.assertGreater(kept["ok"], 0)
        done = self.millstudy("run", "study.toml", "-o", "r.h5", "--json")
        self.assertEqual(done.stderr.splitlines()[0], f"going on after {kept['ok']:,} of 2,000 points")
        self.assertEqual(json.loads(done.stdout)["points"], 2000)
        self.assertEqual(json.loads(self.millstudy("status", "r.h5", "--json").stdout)["status"], "done")

    def test_another_study_is_refused(self):
        self.write(STUDY)
        self.interrupted("r.h5", 0.1, signal.SIGINT, "--threads", "1")
        self.write(STUDY.replace("diameter_mm = 12.0", "diameter_mm = 11.0"))
        before = self.files()
        self.assertEqual(self.refused("run", "study.toml", "-o", "r.h5"),
                         "r.h5.journal: holds the unfinished result of another study; use --fresh to begin "
                         "this one (the journal is moved aside), or -o for another file\n")
        self.assertEqual(self.files(), before)
        done = self.millstudy("run", "study.toml", "-o", "r.h5", "--fresh")
        self.assertIn("the old journal is now r.h5.previous-1.journal\n", done.stderr)
        self.assertEqual(sorted(self.files()), ["r.h5", "r.h5.previous-1.journal", "study.toml"])

    def test_what_is_no_journal_is_refused(self):
        self.write(STUDY)
        (self.folder / "r.h5.journal").write_text("my notes")
        before = self.files()
        self.assertEqual(self.refused("run", "study.toml", "-o", "r.h5"),
                         "r.h5.journal: is not a journal of a run\n")
        self.assertEqual(self.files(), before)

    def test_a_fresh_run_that_was_interrupted_moves_the_old_result_aside_when_it_is_done(self):
        self.write(SLOT)
        self.millstudy("run", "study.toml", "-o", "r.h5")
        old = (self.folder / "r.h5").read_bytes()
        self.write(STUDY)
        self.assertTrue(self.interrupted("r.h5", 0.1, signal.SIGINT, "--fresh", "--threads", "1"))
        self.assertEqual((self.folder / "r.h5").read_bytes(), old)
        self.millstudy("run", "study.toml", "-o", "r.h5")
        self.assertEqual((self.folder / "r.previous-1.h5").read_bytes(), old)

    def test_damage_is_told_and_computed_again(self):
        self.write(STUDY)
        self.millstudy("run", "study.toml", "-o", "whole.h5")
        self.interrupted("r.h5", 0.4, signal.SIGINT, "--threads", "1")
        journal = self.folder / "r.h5.journal"
        content = bytearray(journal.read_bytes())
        content[len(content) // 2] ^= 0x10
        journal.write_bytes(content)
        done = self.millstudy("run", "study.toml", "-o", "r.h5")
        self.assertIn("warning: 1 damaged place in the journal: those blocks are computed again\n",
                      done.stderr)
        self.same("whole.h5", "r.h5")


class Failures(ResumeTest):
    def test_failed_points_are_repeated(self):
        self.write(RADIAL)
        self.millstudy("run", "study.toml", "-o", "r.h5", code=3)
        (self.folder / "whole.h5").write_bytes((self.folder / "r.h5").read_bytes())
        done = self.millstudy("run", "study.toml", "-o", "r.h5", "--failed", code=3)
        self.assertIn("going on after 1,000 of 2,000 points\n", done.stderr)
        self.assertIn("done: 2,000 points, 1,000 ok, 1,000 failed, 0 skipped\n", done.stdout)
        self.same("whole.h5", "r.h5")

    def test_points_of_another_program_are_not_mixed_in(self):
        self.write(RADIAL)
        self.millstudy("run", "study.toml", "-o", "r.h5", code=3)
        with h5py.File(self.folder / "r.h5", "r+") as file:
            file.attrs["isa"] = "x86-64 of the future"
        self.assertIn("was computed by another program or instruction set",
                      self.refused("run", "study.toml", "-o", "r.h5", "--failed"))

    def test_nothing_to_repeat(self):
        self.write(SLOT)
        self.assertEqual(self.refused("run", "study.toml", "-o", "r.h5", "--failed"),
                         "r.h5: there is no result whose failed points --failed could repeat\n")
        self.millstudy("run", "study.toml", "-o", "r.h5")
        before = self.files()
        self.assertIn("already done", self.millstudy("run", "study.toml", "-o", "r.h5", "--failed").stdout)
        self.assertEqual(self.files(), before)

    def test_too_many_end_the_run(self):
        self.write(RADIAL)
        done = self.millstudy("run", "study.toml", "-o", "r.h5", "--max-failures", 10, "--block-size", 8,
                              "--threads", 1, code=4)
        self.assertRegex(done.stderr, r"stopped by \d+ failed points after 1,\d+ of 2,000 points, which are kept")
        self.millstudy("run", "study.toml", "-o", "r.h5", code=3)


def cpu_seconds(process):
    """Computing time that a process has used."""
    fields = pathlib.Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Crashes(ResumeTest):
    @unittest.skipIf(SLOW > 1.0, "sanitizers have signal handlers of their own")
    def test_a_point_that_crashes_twice_is_a_failed_point(self):
        # Of a third of a second each, on one thread: the signal comes while the first of those left is computed.
        self.write(SLOT.replace("angular_steps = 90", 'angular_steps = 1000\nrule = "discs"\ndiscs = 1_000_000') +
                   '[sweep.axes]\n"cutter.helix_deg" = [0.0, 10.0, 20.0, 30.0]\n')
        options = ("-o", "r.h5", "--threads", "1", "--block-size", "2")
        for crash in (1, 2):
            process = self.start(*options)
            while cpu_seconds(process.pid) < 0.15:  # however long the start takes beside other programs
                self.assertIsNone(process.poll())
                time.sleep(0.002)
            process.send_signal(signal.SIGSEGV)
            process.communicate(timeout=60)
            self.assertEqual(process.returncode, -signal.SIGSEGV)
            self.assertEqual((self.folder / "r.h5.journal.crashes").read_text(), "0 11\n" * crash)
        done = self.millstudy("run", "study.toml", *options, code=3)
        self.assertIn("warning: point 0 crashed the program twice (Segmentation fault): it is recorded as failed\n",
                      done.stderr)
        self.assertIn("done: 4 points, 3 ok, 1 failed, 0 skipped\n", done.stdout)
        self.assertIn("  1 failed: crashed the program twice (Segmentation fault)\n", done.stdout)
        self.assertEqual(sorted(self.files()), ["r.h5", "study.toml"])
        # It can be tried again.
        again = self.millstudy("run", "study.toml", *options, "--failed")
        self.assertIn("done: 4 points, 4 ok, 0 failed, 0 skipped\n", again.stdout)

    def test_a_point_that_takes_too_long_is_a_failed_point(self):
        text = SLOT.replace('kind = "force"', 'kind = "stability"\npoint_time_limit_s = 0.2') + """\
[[modes.x]]
frequency_Hz = 900.0
damping_ratio = 0.01
mass_kg = 0.04
[stability]
method = "time_domain"
largest_depth_mm = 1.0
[sweep.axes]
"stability.revolutions" = [10, 1_000_000]
"""
        self.write(text.replace("[numerics]\nangular_steps = 90\n", "").replace("axial_depth_mm = 0.5", "axial_depth_mm = 0.06")
                   .replace("damping_ratio = 0.01", "damping_ratio = 1e-7"))
        begin = time.monotonic()
        done = self.millstudy("run", "study.toml", "-o", "r.h5", code=3)
        self.assertIn(" failed: took longer than study.point_time_limit_s\n", done.stdout)
        self.assertLess(time.monotonic() - begin, 5.0 * SLOW)

    def test_ctrl_c_does_not_wait_for_a_point(self):
        text = SLOT.replace('kind = "force"', 'kind = "stability"') + """\
[[modes.x]]
frequency_Hz = 900.0
damping_ratio = 1e-7
mass_kg = 0.04
[stability]
method = "time_domain"
largest_depth_mm = 1.0
revolutions = 1_000_000
"""
        self.write(text.replace("[numerics]\nangular_steps = 90\n", "").replace("axial_depth_mm = 0.5", "axial_depth_mm = 0.06"))
        process = self.start("-o", "r.h5")
        while not (self.folder / "r.h5.journal").exists():
            self.assertIsNone(process.poll())
            time.sleep(0.002)
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        begin = time.monotonic()
        _, err = process.communicate(timeout=60)
        self.assertLess(time.monotonic() - begin, 2.0 * SLOW)
        self.assertEqual(process.returncode, 4, err)


class Shards(ResumeTest):
    def test_merged_they_are_the_whole(self):
        self.write(RADIAL + "[output]\nharmonics = 2\n")
        self.millstudy("run", "study.toml", "-o", "whole.h5", code=3)
        for shards in (1, 3, 10):
            parts = [f"p{k}.h5" for k in range(1, shards + 1)]
            for k, part in enumerate(parts, 1):
                done = subprocess.run([PROGRAM, "run", "study.toml", "--shard", f"{k}/{shards}", "-o", part],
                                      cwd=self.folder, capture_output=True)
                self.assertIn(done.returncode, (0, 3))
            self.millstudy("merge", f"m{shards}.h5", *parts, code=3)
            self.same("whole.h5", f"m{shards}.h5")
            for part in parts:
                os.remove(self.folder / part)

    def test_whole_chunks_are_copied(self):
        self.write(SLOT + '[sweep.axes]\n"cutter.helix_deg" = { from = 0.0, to = 60.0, count = 100 }\n'
                          '"cut.feed_rate_mm_per_min" = { from = 600.0, to = 3000.0, count = 90 }\n')
        self.millstudy("run", "study.toml", "-o", "whole.h5")
        parts = [f"p{k}.h5" for k in (1, 2)]
        for k, part in enumerate(parts, 1):
            self.millstudy("run", "study.toml", "--shard", f"{k}/2", "-o", part)
        self.millstudy("merge", "m.h5", *parts)
        self.same("whole.h5", "m.h5")
        with h5py.File(self.folder / "m.h5") as all_points, h5py.File(self.folder / "p1.h5") as part:
            for name in ("force_x_max", "status"):
                self.assertLess(part[name].chunks[0], 50)
                self.assertEqual(all_points[name].chunks, part[name].chunks)
                self.assertEqual(all_points[name].id.read_direct_chunk((0,) * part[name].ndim),
                                 part[name].id.read_direct_chunk((0,) * part[name].ndim))

    def test_traces_too(self):
        self.write(SLOT + '[output]\ntraces = true\n[sweep.axes]\n"cutter.helix_deg" = '
                          '{ from = 0.0, to = 60.0, count = 30 }\n')
        self.millstudy("run", "study.toml", "-o", "whole.h5")
        for k in (1, 2):
            self.millstudy("run", "study.toml", "--shard", f"{k}/2")
        self.millstudy("merge", "m.h5", "slot.shard-2-of-2.h5", "slot.shard-1-of-2.h5")
        self.same("whole.h5", "m.h5")

    def test_damaged_traces_are_refused(self):
        self.write(SLOT + "[output]\ntraces = true\n")
        self.millstudy("run", "study.toml", "-o", "good.h5")
        for name, values in (("trace_time", numpy.float32(1.0)), ("trace_force_y", numpy.zeros((2, 3, 4), "f4")),
                             ("trace_start", numpy.zeros((1, 1, 1), "i8")), ("trace_count", numpy.int64([[1 << 40]]))):
            shutil.copy(self.folder / "good.h5", self.folder / "bad.h5")
            with h5py.File(self.folder / "bad.h5", "r+") as file:
                del file[name]
                file[name] = values
            self.assertRegex(self.refused("merge", "m.h5", "bad.h5"), "^bad.h5: (is no readable|cannot be read|has a damaged)")

    def test_gaps_overlaps_and_strangers_are_refused(self):
        self.write(RADIAL)
        for k in (1, 2, 3):
            subprocess.run([PROGRAM, "run", "study.toml", "--shard", f"{k}/3"], cwd=self.folder,
                           capture_output=True)
        first, second, third = (f"slot.shard-{k}-of-3.h5" for k in (1, 2, 3))
        self.write(SLOT, "other.toml")
        self.millstudy("run", "other.toml", "-o", "other.h5")
        before = self.files()
        with h5py.File(self.folder / second) as file:
            count = int(file.attrs["points_ok"] + file.attrs["points_failed"])
            begin = int((file["status"][()].ravel() != 3).argmax())
        numbers = f"{count} points: {begin} to {begin + count - 1}"
        self.assertEqual(self.refused("merge", "m.h5", first, third),
                         f"m.h5: cannot be made: in no part are {numbers}\n")
        self.assertEqual(self.refused("merge", "m.h5", first, second, third, second),
                         f"m.h5: cannot be made: in more than one part are {numbers}\n")
        self.assertEqual(self.refused("merge", "m.h5", first, "other.h5"),
                         f"other.h5: is the result of another study than {first}\n")
        self.assertEqual(self.refused("merge", first, first),
                         f"{first}: is the output of the merge itself\n")
        self.assertRegex(self.refused("merge", "m.h5", "study.toml"), "study.toml: is no readable result file")
        self.assertRegex(self.refused("run", "study.toml", "-o", second), "holds part 2/3 of this study, not all")
        self.assertEqual(self.files(), before)

    def test_a_part_goes_on_too(self):
        self.write(STUDY)
        self.millstudy("run", "study.toml", "-o", "whole.h5")
        self.interrupted("a.h5", 0.1, signal.SIGKILL, "--shard", "1/2", "--threads", "1")
        self.millstudy("run", "study.toml", "-o", "a.h5", "--shard", "1/2")
        self.millstudy("run", "study.toml", "-o", "b.h5", "--shard", "2/2")
        self.millstudy("merge", "m.h5", "a.h5", "b.h5")
        self.same("whole.h5", "m.h5")

    def test_bad_shards(self):
        self.write(SLOT)
        for bad in ("0/3", "4/3", "1", "a/b", "1/3x", "-1/3"):
            self.assertEqual(self.refused("run", "study.toml", "--shard=" + bad),
                             f"--shard {bad}: must be k/K with k from 1 to K: 2/10\n")


if __name__ == "__main__":
    unittest.main()
