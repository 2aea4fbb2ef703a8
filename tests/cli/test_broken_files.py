# SPDX-License-Identifier: MIT
"""Every file of broken/ gives exactly the lines that it announces as `# fault: ...`."""
import os
import shutil
import subprocess
import time
import unittest

from program import PROGRAM, SLOT, SLOW, SOURCE, ProgramTest

BROKEN = SOURCE / "tests" / "cli" / "broken"
LONGEST = 5.0 * SLOW  # [s]


def announced(path):
    mark = "# fault: "
    return [line[len(mark):] for line in path.read_text().splitlines() if line.startswith(mark)]


class BrokenFiles(ProgramTest):
    def setUp(self):
        super().setUp()
        shutil.copytree(BROKEN, self.folder / "broken")

    def test_each_gives_its_lines_and_touches_nothing(self):
        before = self.files()
        names = sorted(path.name for path in BROKEN.glob("*.toml"))
        self.assertGreaterEqual(len(names), 45)
        for name in names:
            for verb in ("run", "plan"):
                with self.subTest(file=name, verb=verb):
                    expected = announced(BROKEN / name)
                    self.assertTrue(expected, "the file announces no fault")
                    started = time.monotonic()
                    done = subprocess.run([PROGRAM, verb, f"broken/{name}"], cwd=self.folder,
                                          text=True, capture_output=True, timeout=4 * LONGEST)
                    self.assertLess(time.monotonic() - started, LONGEST)
                    self.assertEqual(done.stderr.splitlines(), expected)
                    self.assertEqual(done.returncode, 2)
                    self.assertEqual(done.stdout, "")
        self.assertEqual(self.files(), before)


class UnreadableFiles(ProgramTest):
    """Files that cannot be kept in a repository, or are no text."""

    def check(self, name, line):
        before = self.files()
        self.assertEqual(self.refused("run", name), line + "\n")
        self.assertEqual(self.files(), before)

    def test_not_utf_8(self):
        self.write(SLOT.encode().replace(b'"slot"\nkind', b'"fr\xe4sen"\nkind'))
        self.check("study.toml", "study.toml:3: is not UTF-8 text")

    def test_nul_byte(self):
        self.write(SLOT.encode().replace(b"0.5", b"0\x005"))
        self.assertRegex(self.refused("run", "study.toml"), r"\Astudy\.toml:20: [ -~]+\n\Z")

    def test_empty(self):
        self.write("")
        self.check("study.toml",
                   "study.toml: study.kind is missing: one of path, force, path_force, stability, finish")

    def test_one_long_line(self):
        self.write("x" * 100_000)
        said = self.refused("run", "study.toml")
        self.assertRegex(said, r"\Astudy\.toml:1: [^\n]{1,400}\n\Z")

    def test_long_text_does_not_flood_the_terminal(self):
        self.write(SLOT.replace('"slot"\nspindle', '"' + "x" * 100_000 + '"\nspindle'))
        said = self.refused("run", "study.toml")
        self.assertRegex(said, r'\Astudy\.toml:21: cut\.milling = "x{1,400}\.\.\.\n\Z')

    def test_escape_sequences_do_not_reach_the_terminal(self):
        self.write(SLOT.replace('"slot"\nspindle', '"\\u001b[31m"\nspindle'))
        said = self.refused("run", "study.toml")
        self.assertNotIn("\x1b", said)

    def test_many_faults_end_somewhere(self):
        self.write(SLOT + '[sweep.axes]\n"cutter.helix_deg" = [' + "99.0, " * 5000 + "]\n")
        lines = self.refused("run", "study.toml").splitlines()
        self.assertEqual(len(lines), 101)
        self.assertEqual(lines[-1], "and 4900 more")

    def test_missing(self):
        self.check("study.toml", "study.toml: cannot be read: No such file or directory")

    def test_folder(self):
        (self.folder / "study.toml").mkdir()
        self.check("study.toml", "study.toml: is a folder, not a file")

    def test_pipe_that_nobody_writes(self):
        os.mkfifo(self.folder / "study.toml")
        self.check("study.toml", "study.toml: is not a regular file")

    @unittest.skipIf(os.geteuid() == 0, "root reads every file")
    def test_without_permission(self):
        self.write(SLOT)
        (self.folder / "study.toml").chmod(0)
        self.check("study.toml", "study.toml: cannot be read: Permission denied")


if __name__ == "__main__":
    unittest.main()
