# SPDX-License-Identifier: MIT
"""Every command of the documentation works as it stands there, and every link leads somewhere."""
import os
import re
import subprocess
import unittest

from program import PROGRAM, SLOW, SOURCE, ProgramTest

PAGES = sorted([SOURCE / "README.md", SOURCE / "CONTRIBUTING.md", *(SOURCE / "docs").glob("*.md"),
                *(SOURCE / "engine").glob("*/theory.md")])
# Set-up commands: CI itself is the test of these, and tests/install that of the installation.
SET_UP = ("scripts/quickstart.sh", "scripts/test.sh", "cmake --install")
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```", re.MULTILINE | re.DOTALL)
SAVED = re.compile(r"save this as `([^`]+)`:\n\n```toml\n(.*?)^```", re.MULTILINE | re.DOTALL)
LINK = re.compile(r"\]\(([^)#:]+)(?:#[^)]*)?\)")


def commands(page):
    for language, block in BLOCK.findall(page.read_text()):
        if language == "sh":
            for line in block.splitlines():
                if line.strip() and not line.strip().startswith(("#", *SET_UP)):
                    yield line


class Documentation(ProgramTest):
    def setUp(self):
        super().setUp()
        for name in ("studies", "data", "scripts"):
            (self.folder / name).symlink_to(SOURCE / name)
        tools = self.folder / "bin"
        tools.mkdir()
        (tools / "millstudy").symlink_to(os.path.realpath(PROGRAM))
        (tools / "python3").symlink_to("/usr/bin/python3")
        self.environment = {**os.environ, "PATH": f"{tools}:{os.environ['PATH']}"}

    def test_every_command_works(self):
        ran = 0
        for page in PAGES:
            for name, text in SAVED.findall(page.read_text()):
                self.write(text, name)
            for command in commands(page):
                with self.subTest(page=page.name, command=command):
                    done = subprocess.run(command, shell=True, cwd=self.folder, timeout=120 * SLOW,
                                          env=self.environment, text=True, capture_output=True)
                    self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                    ran += 1
        self.assertGreaterEqual(ran, 10)

    def test_the_fault_that_the_readme_shows_is_the_one_it_gives(self):
        readme = (SOURCE / "README.md").read_text()
        (name, text), = SAVED.findall(readme)
        shown, = [block for language, block in BLOCK.findall(readme) if language == "text"]
        self.write(text.replace("1740.0", "-600.0"), name)
        self.assertEqual(self.refused("run", name), shown)

    def test_the_key_reference_is_the_programs(self):
        page = (SOURCE / "docs" / "study_file.md").read_text()
        mark = "<!-- made by: millstudy keys --markdown -->\n\n"
        self.assertEqual(page[page.index(mark) + len(mark):],
                         self.millstudy("keys", "--markdown").stdout)

    def test_the_reference_of_fit_files_is_the_programs(self):
        page = (SOURCE / "docs" / "fit_file.md").read_text()
        mark = "<!-- made by: millstudy keys fit --markdown -->\n\n"
        self.assertEqual(page[page.index(mark) + len(mark):],
                         self.millstudy("keys", "fit", "--markdown").stdout)

    def test_every_key_is_shown_in_a_ready_made_study(self):
        shown = " ".join(path.read_text() for folder in ("studies", "data")
                         for path in sorted((SOURCE / folder).rglob("*.toml")))
        keys = set(re.findall(r"^  [a-z_.0-9]+\.(\w+)", self.millstudy("keys").stdout, re.MULTILINE))
        self.assertGreater(len(keys), 60)
        self.assertEqual([key for key in sorted(keys) if not re.search(rf"\b{key}\b", shown)], [])

    def test_every_link_leads_somewhere(self):
        for page in PAGES:
            for target in LINK.findall(page.read_text()):
                with self.subTest(page=page.name, target=target):
                    self.assertTrue((page.parent / target).exists())


if __name__ == "__main__":
    unittest.main()
