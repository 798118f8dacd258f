"""The package itself: it installs without a network, its types hold, its page's example runs."""
import importlib.util
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

import lore
from support import SOURCE_DIR, LoreTest, evolve, program

PACKAGE = SOURCE_DIR / "tools" / "python"


class Package(LoreTest):
    def run_python(self, *arguments: object, cwd: pathlib.Path | None = None) -> str:
        environment = {**os.environ, "PYTHONPATH": str(PACKAGE), "PYTHONDONTWRITEBYTECODE": "1", "MPLBACKEND": "agg"}
        ran = subprocess.run([*map(str, arguments)], capture_output=True, text=True, cwd=cwd, env=environment)
        self.assertEqual(ran.returncode, 0, f"{arguments}: {ran.stdout}{ran.stderr}")
        return ran.stdout

    def test_has_the_version_of_lore(self) -> None:
        project = (SOURCE_DIR / "CMakeLists.txt").read_text()
        self.assertIn(f"project(Lore VERSION {lore.__version__} ", project)

    def test_installs_from_the_source_tree_without_a_network(self) -> None:
        if any(importlib.util.find_spec(module) is None for module in ("setuptools", "wheel", "ensurepip", "pip")):
            self.skipTest("python3-venv, python3-pip, python3-setuptools or python3-wheel is not here")
        source = self.scratch / "python"
        shutil.copytree(PACKAGE, source, ignore=shutil.ignore_patterns("build", "*.egg-info", "__pycache__"))
        environment = self.scratch / "environment"
        self.run_python(sys.executable, "-m", "venv", "--system-site-packages", environment)
        python = environment / "bin" / "python3"
        self.run_python(python, "-m", "pip", "install", "-q", "--no-index", "--no-build-isolation", source)
        said = self.run_python(
            python, "-I", "-c", "import lore, lore_world, lore_gymnasium, os; print(lore.__version__, os.listdir(os.path.dirname(lore.__file__)))",
            cwd=self.scratch,
        )  # fmt: skip
        self.assertIn(lore.__version__, said)
        self.assertIn("py.typed", said)

    def test_types_hold(self) -> None:
        if importlib.util.find_spec("mypy") is None:
            self.skipTest("mypy is not here")
        self.run_python(sys.executable, "-m", "mypy", "--cache-dir", self.scratch / "mypy", "--config-file", PACKAGE / "pyproject.toml", "lore",
                        "lore_world.py", "lore_gymnasium.py", cwd=PACKAGE)  # fmt: skip

    def test_works_without_pandas_and_matplotlib(self) -> None:
        block = "import sys; sys.modules['pandas'] = sys.modules['matplotlib'] = None; import lore; print(lore.Table)"
        self.assertIn("Table", self.run_python(sys.executable, "-c", block))

    def test_the_example_of_its_page_runs(self) -> None:
        if any(importlib.util.find_spec(module) is None for module in ("pandas", "matplotlib")):
            self.skipTest("pandas or matplotlib is not here")
        evolve(self.scratch / "runs" / "s1")
        program("lore-kb", "build", self.scratch / "runs" / "s1", "--out", self.scratch / "kb1.lorekb", "-q")
        evolve(self.scratch / "runs" / "small" / "runs" / "none" / "001")
        shutil.copytree(SOURCE_DIR / "docs" / "results" / "paper", self.scratch / "runs" / "small", dirs_exist_ok=True)
        page = (SOURCE_DIR / "docs" / "manual" / "python.md").read_text()
        examples = re.findall(r"^```python\n(.*?)^```", page, re.M | re.S)
        self.assertEqual(len(examples), 1)
        (self.scratch / "example.py").write_text(examples[0])
        said = self.run_python(sys.executable, "example.py", cwd=self.scratch)
        self.assertIn("damaged", said)
        self.assertTrue((self.scratch / "figure3.svg").exists())


if __name__ == "__main__":
    unittest.main()
