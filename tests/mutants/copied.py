"""A copy of the tree to mutate: it is compiled by cargo, and its test programs judge the mutants."""
import json
import os
import shutil
import subprocess
import threading
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
# a mutant that takes longer than this loops
SECONDS = 300


def copy_into(folder, edits):
    """Copies the tree into a folder, with the edited texts of some files by path, and returns its path.

    A file that has its content already is left as it is, because cargo compiles what is newer.
    """
    tree = Path(folder) / "tree"

    def write(source, target):
        content = edits.get(str(Path(source).relative_to(ROOT)))
        content = Path(source).read_bytes() if content is None else content.encode()
        target = Path(target)
        if not target.is_file() or target.read_bytes() != content:
            target.write_bytes(content)

    ignore = shutil.ignore_patterns("target", ".git", "mutants.out*", "__pycache__")
    shutil.copytree(ROOT, tree, ignore=ignore, dirs_exist_ok=True, copy_function=write)
    return tree


def build(tree, selection=("--tests",)):
    """Compiles test programs of the tree. Returns their paths, by `lib` for unit tests, else by their names."""
    command = ["cargo", "test", "--no-run", "--message-format=json-render-diagnostics", *selection]
    built = subprocess.run(command, cwd=tree, stdout=subprocess.PIPE, check=True, text=True)
    programs = {}
    for message in map(json.loads, built.stdout.splitlines()):
        if message.get("profile", {}).get("test") and message.get("executable"):
            kind, package = message["target"]["kind"], Path(message["manifest_path"]).parent
            name = message["target"]["name"] if kind == ["test"] else kind[0]
            # a unit test of another package than the library
            key = name if name not in programs else f"{package.name}:{name}"
            programs[key] = message["executable"]
    return programs


def fails(program, filters, tree, mutant=None):
    """Whether a test that a filter selects fails. The first failure ends the program."""
    environment = dict(os.environ, PROPTEST_CASES="16", PROPTEST_MAX_SHRINK_ITERS="64", INSTA_UPDATE="no")
    environment.pop("AFFINOR_MUTANT", None)
    if mutant is not None:
        environment["AFFINOR_MUTANT"] = mutant
    running = subprocess.Popen(
        [program, *filters], cwd=tree, env=environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    )
    late = threading.Timer(SECONDS, running.kill)
    late.start()
    try:
        for line in running.stdout:
            if line.startswith("test ") and line.rstrip().endswith("FAILED"):
                running.kill()
        return running.wait() != 0
    finally:
        late.cancel()
