"""Puts the sources of the site together: the pages of docs/, the notebooks, and pages that the program writes.

    python docs/site/assemble.py PROGRAM FOLDER [PAGE]

PROGRAM is the command `affinor`, FOLDER the new source folder of Sphinx, and PAGE the built page of `web/`, which becomes `try/`.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
REPOSITORY = tomllib.loads((ROOT / "Cargo.toml").read_text())["workspace"]["package"]["repository"] + "/blob/main/"
"""Where files are that have no page."""

PROJECT = {"CHANGELOG.md": "changelog.md", "CONTRIBUTING.md": "contributing.md", "ARCHITECTURE.md": "architecture.md"}
"""Files of the repository that are pages."""

TUTORIALS = ["geometry.md", "mechanics.md", "two_geometries.md", "charts.md"]
"""Pages that end with a link to the page in the browser, if that is built. The index has it above its sections."""

INVITATION = '\n<p><a href="try/index.html">Try it in the browser</a>, without an installation.</p>\n'
"""The link."""

PICTURES = [
    ("A precessing top", "plot animation examples/motions/precessing_top.toml --seconds 8"),
    ("Two rods in a row", "plot animation examples/motions/double_pendulum.toml --seconds 8"),
    ("A satellite with an arm", "plot animation examples/motions/joined_bodies.toml --seconds 8"),
    ("The rates of a tumbling satellite", "plot series examples/motions/satellite.toml --columns Omega1,Omega2,Omega3"),
    ("The polhode of a body near its middle axis", "plot momentum examples/motions/dzhanibekov.toml"),
    ("The axes of a heavy top", "plot attitude examples/motions/heavy_top.toml"),
    ("Transport in two geometries of rotation", "plot transport"),
    ("Geodesics of three metrics", 'plot autoparallels --connection plus --connection levi-civita --metric diag(1,2,3)'),
    ("The Dynkin diagram of E8", "plot dynkin E8"),
    ("A body in a fluid", "plot phase examples/motions/kirchhoff.toml --columns g14,g24"),
    ("Drift of two methods", "plot drift examples/motions/body_in_potential.toml --method rkmk4 --method kick4 --step 0.05 --relative"),
    ("Slopes of methods", "plot convergence examples/motions/body_in_potential.toml"),
]
"""Titles and commands of the gallery."""

FIRST = 'affinor table so3 --metric "diag(a,b,c)" --show ricci'
"""The command of the index, which shows its output."""

CATALOGUE = """# Catalogue

The families of algebras that have a name. Names in a sum are separated by `+`: `so3+R^3`. `affinor list heis` prints the entries that match a
word, and `affinor list --where "dimension=4, nilpotent"` those with [properties](structure.md#the-catalogue-by-properties).
"""
"""The head of the catalogue."""

Run = Callable[..., str]
"""Runs the program with arguments and returns its output."""


def main(program: str, folder: Path, web: Path | None) -> None:
    """Writes all sources into the folder."""

    def run(*arguments: str) -> str:
        done = subprocess.run([program, *arguments], cwd=ROOT, capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(f"affinor {' '.join(arguments)}: {done.stderr}")
        return done.stdout

    site = ROOT / "docs" / "site"
    shutil.copytree(site, folder, ignore=shutil.ignore_patterns("assemble.py", "check.mjs", "__pycache__"))
    static = folder / "static"
    for picture in (ROOT / "docs").glob("*.svg"):
        shutil.copy(picture, static)
        shutil.copy(picture, folder)
    shutil.copytree(ROOT / "docs" / "schemas", folder / "schemas")
    pages = {ROOT / name: page for name, page in PROJECT.items()}
    for kind in ["*.md", "how-to/*.md"]:
        pages |= {page: str(page.relative_to(ROOT / "docs")) for page in (ROOT / "docs").glob(kind)}
    (folder / "how-to").mkdir()
    notebooks = ROOT / "python" / "notebooks"
    shutil.copytree(notebooks, folder / "notebooks", ignore=shutil.ignore_patterns("5_*", ".*"))
    # files whose place on the site is taken by a page of another form
    others = {notebook: f"notebooks/{notebook.name}" for notebook in notebooks.glob("[1-46]_*.ipynb")}
    others[ROOT / "python" / "README.md"] = "python.rst"
    for source, page in pages.items():
        (folder / page).write_text(outward(source, page, pages | others), encoding="utf-8")
    index = folder / "index.md"
    shown = f"$ {FIRST}\n{run(*shlex.split(FIRST)[1:])}"
    index.write_text(index.read_text(encoding="utf-8").replace(f"$ {FIRST}\n", shown), encoding="utf-8")
    if web:
        shutil.copytree(web, folder / "extra" / "try")
        text = index.read_text(encoding="utf-8")
        index.write_text(text.replace("\n## ", f"{INVITATION}\n## ", 1), encoding="utf-8")
        for name in TUTORIALS:
            with (folder / name).open("a", encoding="utf-8") as page:
                page.write(INVITATION)

    (folder / "help.md").write_text("\n".join(["# Help of every command\n", *help_of(run, [])]), encoding="utf-8")
    listed = run("list", "--format", "markdown").split("\n", 1)[1]
    (folder / "catalogue.md").write_text(f"{CATALOGUE}\n{listed}", encoding="utf-8")
    gallery = folder / "gallery.md"
    head = gallery.read_text(encoding="utf-8").replace("](../", f"]({REPOSITORY}")
    gallery.write_text("\n".join([head, *pictures(run, static)]), encoding="utf-8")
    (folder / "python.rst").write_text("\n".join(reference()), encoding="utf-8")


def help_of(run: Run, command: list[str]) -> list[str]:
    """The help of a command and of its subcommands, as the program prints it."""
    text = run(*command, "--help")
    # deeper headings would not be links
    heading = "#" * min(len(command) + 1, 3)
    parts = [f"{heading} affinor {' '.join(command)}\n"] if command else []
    parts.append(f"```text\n{text}```\n")
    listed = re.search(r"Commands:\n(.*?)\n\n", text, re.S)
    names = re.findall(r"^  (\w[\w-]*)", listed[1], re.M) if listed else []
    return parts + [part for name in names if name != "help" for part in help_of(run, [*command, name])]


def pictures(run: Run, static: Path) -> list[str]:
    """Draws the pictures of the gallery, and returns their sections."""
    parts = []
    for at, (title, command) in enumerate(PICTURES):
        run(*command.split(), "-o", str(static / f"gallery{at}.svg"))
        shown = re.sub(r"(diag\(.*?\))", r'"\1"', command)
        file = re.search(r"\S+\.toml", command)
        source = f"[{Path(file[0]).name}]({REPOSITORY}{file[0]})\n\n" if file else ""
        parts.append(f"## {title}\n\n![{title}](static/gallery{at}.svg)\n\n{source}```sh\naffinor {shown}\n```\n")
    return parts


def reference() -> list[str]:
    """The lines of the reference of the Python package: its public names by kind."""
    import affinor

    kinds: dict[str, list[str]] = {"Classes": [], "Functions": [], "Groups": [], "Errors": []}
    for name in sorted(affinor.__all__, key=str.lower):
        found = getattr(affinor, name)
        error = isinstance(found, type) and issubclass(found, Exception)
        kind = "Errors" if error else "Classes" if isinstance(found, type) else "Functions" if callable(found) else "Groups"
        directive = {"Functions": "autofunction", "Groups": "autodata"}.get(kind, "autoclass")
        kinds[kind].append(f".. {directive}:: {name}")
        if isinstance(found, type):
            kinds[kind].append("   :members:")
            # those of a base class that has no section of its own
            if affinor._bulk.Bulk in found.__mro__:
                kinds[kind].append("   :inherited-members:")
        kinds[kind].append("")
    lines = ["Python reference", "================", "", ".. currentmodule:: affinor", ""]
    for kind, sections in kinds.items():
        lines += [kind, "-" * len(kind), "", *sections]
    return lines


def outward(source: Path, page: str, pages: dict[Path, str]) -> str:
    """The text of a page: links to other pages lead to these, and links to other files to the repository."""

    def target(match: re.Match[str]) -> str:
        path, mark, anchor = match[1].partition("#")
        found = (source.parent / path).resolve()
        if "://" in path or not path or not found.exists():
            return match[0]
        if found in pages:
            return f"]({os.path.relpath(pages[found], Path(page).parent)}{mark}{anchor})"
        if found.is_relative_to(ROOT / "docs") and found.suffix in {".svg", ".json"}:
            return match[0]
        return f"]({REPOSITORY}{found.relative_to(ROOT)})"

    return re.sub(r"\]\(([^()\s]*)\)", target, source.read_text(encoding="utf-8"))


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]), Path(sys.argv[3]) if len(sys.argv) > 3 else None)
