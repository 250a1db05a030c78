"""What the build of the site does not check by itself."""

import importlib.metadata
import re
import runpy
from pathlib import Path

import pytest

import givens as gv

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "python" / "docs"
EXAMPLES = sorted((ROOT / "python" / "examples").glob("*.py"))


def test_the_reference_has_every_public_name_once():
    text = "\n".join(page.read_text() for page in (DOCS / "api").glob("*.md"))
    named = re.findall(r"^\.\. auto(?:class|function):: givens\.(\w+)$", text, re.MULTILINE)
    assert sorted(named) == sorted(gv.__all__)


def test_the_version_is_that_of_what_is_installed():
    assert gv.__version__ == importlib.metadata.version("givens")


def test_each_page_is_in_a_table_of_contents():
    pages = {page.relative_to(DOCS).with_suffix("").as_posix() for page in DOCS.rglob("*.md")}
    listed = {"index"}
    for page in DOCS.rglob("*.md"):
        for tree in re.findall(r"```\{toctree\}\n(.*?)```", page.read_text(), re.DOTALL):
            names = [line for line in tree.splitlines() if line and not line.startswith(":")]
            listed |= {(page.parent / name).relative_to(DOCS).as_posix() for name in names}
    assert pages - listed == {"examples/data/CREDITS"}


def test_the_readme_runs_as_it_stands():
    blocks = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.DOTALL)
    assert len(blocks) == 1
    found = {}
    exec(blocks[0], found)
    assert len(found["est"]) == 3
    assert found["est"].nis_dof.tolist() == [1, 0, 1]


@pytest.mark.parametrize("script", EXAMPLES, ids=lambda path: path.stem)
def test_the_script_runs(script, capsys):
    runpy.run_path(str(script), run_name="__main__")
    assert capsys.readouterr().out
