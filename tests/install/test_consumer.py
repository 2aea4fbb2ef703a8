# SPDX-License-Identifier: MIT
"""Installs the build, builds a project outside of this tree against it, and runs both."""
import os
import pathlib
import subprocess
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
CMAKE, BUILD = os.environ["CMAKE"], os.environ["BUILD"]


class Consumer(unittest.TestCase):
    def command(self, *words):
        done = subprocess.run([str(word) for word in words], text=True, capture_output=True)
        self.assertEqual(done.returncode, 0, f"{words}\n{done.stdout}{done.stderr}")
        return done.stdout

    def test_the_installed_package_is_enough(self):
        with tempfile.TemporaryDirectory(prefix="millstudy-install-") as folder:
            prefix, build = pathlib.Path(folder) / "prefix", pathlib.Path(folder) / "build"
            self.command(CMAKE, "--install", BUILD, "--prefix", prefix)
            self.assertRegex(self.command(prefix / "bin" / "millstudy", "--version"), r"\d+\.\d+\.\d+")
            # Where the package goes: no path of this tree may be needed by those who use it.
            for file in prefix.rglob("*.cmake"):
                self.assertNotIn(str(HERE.parents[1]), file.read_text(), file)
            self.command(CMAKE, "-S", HERE / "consumer", "-B", build, "-G", os.environ["GENERATOR"],
                         f"-DCMAKE_PREFIX_PATH={prefix}", "-DCMAKE_BUILD_TYPE=Release",
                         f"-DCMAKE_CXX_COMPILER={os.environ['CXX']}")
            self.command(CMAKE, "--build", build)
            said = self.command(build / "consumer")
            self.assertRegex(said, r"\Amean resultant: 56\.63\d\d N\nperiods along a line: (100|101)\n\Z")


if __name__ == "__main__":
    unittest.main()
