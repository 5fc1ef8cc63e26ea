#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that the engine's topics depend on each other in one direction only.

  layering.py SOURCE_TREE [PROGRAM]   checks the tree, and that PROGRAM links no Qt
  layering.py --self-test             checks that each kind of fault is found

A topic includes only topics listed before it (and itself). Headers of heavy libraries stay out of
engine/include, and nothing in engine/ or cli/ includes Qt.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

# The order of docs/architecture.md. `pipeline` is engine/include/toile/pipeline.h and its source.
TOPICS = ("core mesh curve model design edit cut unfold develop finish layout fit transfer warp body "
          "scan shape sew render io pipeline batch").split()
ORDER = {topic: i for i, topic in enumerate(TOPICS)}

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')
PRIVATE_LIBRARIES = re.compile(
    r"^(CGAL/|boost/|embree|rtcore|tbb/|oneapi/|suitesparse/|cholmod|umfpack|SuiteSparse|"
    r"Eigen/(Cholmod|UmfPack)Support|polyclipping/|clipper|cairo|pango|dxflib/|dl_|png\.h|cblas)")
QT = re.compile(r"^(Q[A-Z]\w*|Qt\w+/.*)$")


def topic_of(path, root):
    """The topic a source belongs to, by its place in the tree."""
    parts = path.relative_to(root).parts
    rest = parts[3:] if parts[1] == "include" else parts[2:]  # engine/include/toile/… or engine/src/…
    return rest[0] if len(rest) > 1 else pathlib.PurePath(rest[0]).stem


def included_topic(name, root):
    """The topic that an #include line means, or None when it is no header of ours."""
    if name.startswith("toile/"):
        rest = name.split("/")[1:]
        return rest[0] if len(rest) > 1 else pathlib.PurePath(rest[0]).stem
    first = name.split("/")[0]
    is_folder = first != ".." and "/" in name and (root / "engine/src" / first).is_dir()
    return first if is_folder else None


def check_tree(root):
    faults = []
    public = root / "engine/include"
    for path in sorted((root / "engine").rglob("*")):
        if path.suffix not in (".h", ".cpp"):
            continue
        where = path.relative_to(root).as_posix()
        topic = topic_of(path, root)
        if topic not in ORDER:
            faults.append(f"{where}: '{topic}' is no topic; they are: {' '.join(TOPICS)}")
            continue
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            name = match.group(1)
            other = included_topic(name, root)
            if other is not None and ORDER.get(other, len(TOPICS)) > ORDER[topic]:
                faults.append(f"{where}:{number}: topic {topic} includes {name}, "
                              f"but {other} comes after {topic}")
            if name.startswith("../"):
                faults.append(f"{where}:{number}: {name}: name the topic, not the way to it")
            if public in path.parents and other is not None and not name.startswith("toile/"):
                faults.append(f"{where}:{number}: {name} is private, this header is not")
            if public in path.parents and PRIVATE_LIBRARIES.match(name):
                faults.append(f"{where}:{number}: {name} must stay in engine/src")
    for folder in ("engine", "cli"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in (".h", ".cpp"):
                continue
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                match = INCLUDE.match(line)
                if match and QT.match(match.group(1)):
                    faults.append(f"{path.relative_to(root).as_posix()}:{number}: "
                                  f"{match.group(1)} belongs to Qt, which only the studio uses")
    return faults


def check_program(program):
    listing = subprocess.run(["readelf", "-d", program], capture_output=True, text=True, check=True)
    return [f"{program} links {name}" for name in
            re.findall(r"\(NEEDED\).*\[(libQt[^\]]*)\]", listing.stdout)]


def self_test():
    cases = {  # file -> (content, text that the fault must contain, or None)
        "engine/src/cut/good.cpp": ('#include "toile/cut/a.h"\n#include "toile/mesh/b.h"\n', None),
        "engine/src/cut/library.cpp": ("#include <CGAL/Surface_mesh.h>\n", None),
        "engine/src/pipeline.cpp": ('#include "toile/io/write.h"\n', None),
        "engine/src/cut/later.cpp": ('#include "toile/io/write.h"\n', "io comes after cut"),
        "engine/src/cut/private.cpp": ('#include "layout/inner.h"\n', "layout comes after cut"),
        "engine/src/layout/inner.h": ("", None),
        "engine/src/layout/way.cpp": ('#include "../cut/inner.h"\n', "name the topic"),
        "engine/include/toile/layout/private.h": ('#include "layout/inner.h"\n', "is private"),
        "engine/include/toile/mesh/up.h": ('  #  include "toile/pipeline.h"\n', "pipeline comes"),
        "engine/include/toile/mesh/cgal.h": ("#include <CGAL/x.h>\n", "must stay in engine/src"),
        "engine/include/toile/mesh/embree.h": ("#include <embree3/rtcore.h>\n", "must stay"),
        "engine/include/toile/mesh/tbb.h": ("#include <tbb/task.h>\n", "must stay"),
        "engine/include/toile/mesh/cholmod.h": ("#include <cholmod.h>\n", "must stay"),
        "engine/src/pattern/a.cpp": ("", "'pattern' is no topic"),
        "cli/window.cpp": ("#include <QWidget>\n", "belongs to Qt"),
    }
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for name, (content, _) in cases.items():
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(content, encoding="utf-8")
        faults = check_tree(root)
    wrong = [f"{name}: expected {text!r}, got {mine}" for name, (_, text) in cases.items()
             if (mine := [f for f in faults if f.startswith(name)]) is not None
             and (bool(mine) != (text is not None) or (text and text not in mine[0]))]
    return wrong


def main(args):
    if args == ["--self-test"]:
        faults = self_test()
    else:
        faults = check_tree(pathlib.Path(args[0]).resolve())
        if len(args) > 1:
            faults += check_program(args[1])
    print("\n".join(faults) if faults else "no faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
