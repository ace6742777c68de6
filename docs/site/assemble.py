"""Puts the sources of the site together: the pages of docs/, the notebooks, and pages that the program writes.

    python docs/site/assemble.py PROGRAM FOLDER

PROGRAM is the command `affinor`, FOLDER the new source folder of Sphinx.
"""

import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
REPOSITORY = tomllib.loads((ROOT / "Cargo.toml").read_text())["workspace"]["package"]["repository"] + "/blob/main/"
"""Where files are that have no page."""

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


def main(program: str, folder: Path) -> None:
    """Writes all sources into the folder."""

    def run(*arguments: str) -> str:
        done = subprocess.run([program, *arguments], cwd=ROOT, capture_output=True, text=True)
        if done.returncode:
            raise SystemExit(f"affinor {' '.join(arguments)}: {done.stderr}")
        return done.stdout

    site = ROOT / "docs" / "site"
    shutil.copytree(site, folder, ignore=shutil.ignore_patterns("assemble.py", "__pycache__"))
    static = folder / "static"
    static.mkdir()
    for picture in (ROOT / "docs").glob("*.svg"):
        shutil.copy(picture, static)
        shutil.copy(picture, folder)
    # the style guide is for contributors
    found = (page for page in (ROOT / "docs").glob("*.md") if page.name != "style.md")
    pages = {page.name: page.read_text(encoding="utf-8") for page in found}
    pages["changelog.md"] = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
    for name, text in pages.items():
        (folder / name).write_text(outward(text), encoding="utf-8")
    shutil.copytree(ROOT / "python" / "notebooks", folder / "notebooks", ignore=shutil.ignore_patterns("5_*", ".*"))

    # help of every command, as the program prints it
    listed = re.search(r"Commands:\n(.*?)\n\n", run("--help"), re.S)
    commands = [line.split()[0] for line in listed[1].splitlines() if re.match(r"  \w", line)] if listed else []
    parts = ["# Help of every command\n", f"```text\n{run('--help')}```\n"]
    for command in commands:
        if command != "help":
            parts.append(f"## {command}\n\n```text\n{run(command, '--help')}```\n")
    (folder / "help.md").write_text("\n".join(parts), encoding="utf-8")
    (folder / "catalogue.md").write_text(f"# Catalogue\n\n```text\n{run('list')}```\n", encoding="utf-8")

    gallery = folder / "gallery.md"
    parts = [gallery.read_text(encoding="utf-8")]
    for at, (title, command) in enumerate(PICTURES):
        run(*command.split(), "-o", str(static / f"gallery{at}.svg"))
        shown = re.sub(r"(diag\(.*?\))", r'"\1"', command)
        parts.append(f"## {title}\n\n```sh\naffinor {shown}\n```\n\n![{title}](static/gallery{at}.svg)\n")
    gallery.write_text("\n".join(parts), encoding="utf-8")

    import affinor

    lines = ["Python reference", "================", "", ".. currentmodule:: affinor", ""]
    for name in sorted(affinor.__all__, key=str.lower):
        found = getattr(affinor, name)
        kind = "autoclass" if isinstance(found, type) else "autofunction" if callable(found) else "autodata"
        members = ["   :members:"] if kind == "autoclass" else []
        # those of a base class that has no section of its own
        if kind == "autoclass" and affinor._bulk.Bulk in found.__mro__:
            members.append("   :inherited-members:")
        lines += [name, "-" * len(name), "", f".. {kind}:: {name}", *members, ""]
    (folder / "python.rst").write_text("\n".join(lines), encoding="utf-8")


def outward(text: str) -> str:
    """A page whose links to files outside of the site lead to the repository."""
    text = text.replace("](schemas/", "](../docs/schemas/")
    text = re.sub(r"\]\(\.\./([^)]*)\)", lambda match: f"]({REPOSITORY}{match[1]})", text)
    return re.sub(r"\]\((docs/)", "](", text)


if __name__ == "__main__":
    main(sys.argv[1], Path(sys.argv[2]))
