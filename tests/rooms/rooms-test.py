"""Reads the includes of the library, the harness and the command, and the imports of the kernels, and says which of them
layers.txt does not allow. Reads what their files declare, and says what stands in another namespace than its room's.

usage: rooms-test.py SOURCE [LAYERS]
"""

import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<(tessera/[^>]+)>)', re.MULTILINE)
# A public header is read by programs that have none of these.
FOREIGN = re.compile(r'^\s*#\s*include\s*[<"](vulkan|OpenMesh|OpenImageIO|Imath|OpenEXR|nlohmann|CLI|fmt|tbb|toml\+\+)[/.]', re.MULTILINE)

# What is no declaration: comments, texts and the preprocessor's lines.
NO_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*|R"(\w*)\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)+\'', re.MULTILINE | re.DOTALL)
SCOPE = re.compile(r'\bnamespace\s+([\w:]+)?\s*\{|\{|\}|[^\s{}]')
# Folders that are no rooms of layers.txt, and have a namespace all the same.
ASIDE = {"bench": "bench", "tests": "test"}
# The oracle has words of its own for what others name, too (`render`, `transform`), so its public header keeps to its room's namespace.
OWN_PUBLIC = {"host/include/tessera/oracle.h": "tessera::oracle"}

IMPORT = re.compile(r'^\s*(?:public\s+|__exported\s+)*(?:import|__include)\s+"?([\w./-]+)"?\s*;', re.MULTILINE)
PART = re.compile(r'^\s*implementing\s+(\w+)\s*;', re.MULTILINE)
GENERATED = ("settings", "variant")  # by the host, of constants and of the files that are parts of them
TARGET = re.compile(r'\bTESSERA_CPP\b|\bTESSERA_WGSL\b|__target_switch|__intrinsic_asm|__requirePrelude|__target_intrinsic')
ENTRY = re.compile(r'\[\s*numthreads\s*\(')


def rooms_of(layers):
    """Room to (folder, the rooms that it may include)."""
    rooms = {}
    for line in layers.read_text().splitlines():
        words = line.split()
        if not words or words[0].startswith("#"):
            continue
        unknown = [word for word in words[2:] if word not in rooms]
        if unknown:
            sys.exit(f"{layers}: {words[0]} may include {unknown[0]}, which is not a room above that line")
        if words[0] in rooms:
            sys.exit(f"{layers}: {words[0]} has two lines")
        rooms[words[0]] = (words[1], {words[0], *words[2:]})
    return rooms


def room_of(path, rooms):
    inside = [room for room, (folder, _) in rooms.items() if path.startswith(folder + "/")]
    return max(inside, key=lambda room: len(rooms[room][0]), default=None)


def circle(includes):
    """A path of includes that comes back to its beginning, or nothing."""
    done = set()

    def walk(path, way):
        if path in way:
            return [*way[way.index(path):], path]
        if path in done:
            return None
        for target in sorted(includes.get(path, ())):
            found = walk(target, [*way, path])
            if found:
                return found
        done.add(path)
        return None

    for path in sorted(includes):
        found = walk(path, [])
        if found:
            return found
    return None


def read_cpp(source, rooms, faults):
    """File of the host to the files that it includes."""
    includes = {}
    for top in ("host", "datasets", "experiments/harness"):
        for file in sorted((source / top).rglob("*")):
            path = file.relative_to(source).as_posix()
            if file.suffix not in (".h", ".cpp") or "third-party" in path:
                continue
            room = room_of(path, rooms)
            if room is None:
                faults.append(f"{path}: in no room of layers.txt")
                continue
            text = file.read_text()
            if room == "public" and FOREIGN.search(text):
                faults.append(f"{path}: a public header, and includes {FOREIGN.search(text).group(1)}")
            includes[path] = set()
            for quoted, public in INCLUDE.findall(text):
                target = "host/include/" + public if public else quoted
                if not (source / target).is_file():
                    if public or target.startswith(("host/", "datasets/", "experiments/")) and target != "host/build-info.h":
                        faults.append(f"{path}: includes {public or quoted}, which is not there")
                    continue
                includes[path].add(target)
                other = room_of(target, rooms)
                if other is None or other not in rooms[room][1]:
                    faults.append(f"{path}: {room} includes {target} of {other}")
    if len(includes) < 100:
        faults.append(f"only {len(includes)} files were read")
    return includes


def namespaces(text):
    """The namespaces that a file opens, by their full names, and "" where something stands in none."""
    opened, inside = set(), []
    for match in SCOPE.finditer(NO_CODE.sub(" ", text)):
        word = match.group(0)
        if word.endswith("{"):
            inside.append(match.group(1) or "")  # "" for a namespace without a name, a class or a function
            if match.group(1):
                opened.add("::".join(part for part in inside if part))
        elif word == "}" and inside:
            inside.pop()
        elif not inside:
            opened.add("")
    return opened


def read_names(source, rooms, faults):
    """Each header declares into its room's namespace alone; what implements a public header opens `tessera`, too."""
    count = 0
    for top in ("host", "datasets", "experiments/harness", *ASIDE):
        for file in sorted((source / top).rglob("*")):
            path = file.relative_to(source).as_posix()
            if file.suffix not in (".h", ".cpp") or "third-party" in path or "/new/" in path:
                continue
            room = ASIDE.get(top) or room_of(path, rooms)
            own = OWN_PUBLIC.get(path, "tessera") if room == "public" else f"tessera::{room}"
            count += 1
            for name in sorted(namespaces(file.read_text())):
                if name == own or room != "public" and name.startswith(own + "::"):
                    continue
                if file.suffix == ".cpp" and name in ("", "tessera"):
                    continue
                faults.append(f"{path}: declares into {name or 'no namespace'}, and {own} would be right")
    if count < 100:
        faults.append(f"of only {count} files the namespaces were read")


def read_slang(source, rooms, faults):
    """File of the kernels to the files that it imports."""
    texts = {file.relative_to(source).as_posix(): re.sub(r"//[^\n]*", "", file.read_text()) for file in sorted((source / "slang").rglob("*.slang"))}
    places = [folder for folder, _ in rooms.values() if folder.startswith("slang/")] + ["slang"]
    parts = {module: [path for path, text in texts.items() if module in PART.findall(text)] for module in GENERATED}

    def found(path, module):
        """The files that an import reads: beside the importing file, else in a room, as slangc looks for them."""
        if module in GENERATED:
            return parts[module]
        name = module.removesuffix(".slang") if "/" in module or module.endswith(".slang") else module.replace(".", "/")
        for folder in (path.rpartition("/")[0], *places):
            for file in (f"{folder}/{name.replace('_', '-')}.slang", f"{folder}/{name}.slang"):
                if file in texts:
                    return [file]
        return None

    imports, names = {}, {}
    for path, text in texts.items():
        room = room_of(path, rooms)
        if room is None:
            faults.append(f"{path}: in no room of layers.txt")
            continue
        imports[path] = set()
        for module in [*IMPORT.findall(text), *(file for file, _ in INCLUDE.findall(text) if file)]:
            targets = found(path, module)
            if targets is None:
                faults.append(f"{path}: imports {module}, which is not there")
                continue
            for target in targets:
                imports[path].add(target)
                other = room_of(target, rooms)
                if other not in rooms[room][1]:
                    faults.append(f"{path}: {room} imports {module}, which reads {target} of {other}")
                    break
        for module in PART.findall(text):
            home = {"settings": "slang-wide", "variant": "slang-axes"}.get(module)
            if room != home:
                faults.append(f"{path}: a part of {module}, and not in {home}")
        if room != "slang-machine" and TARGET.search(text):
            faults.append(f"{path}: knows its target ({TARGET.search(text).group(0)}), and is not in slang-machine")
        if (room == "slang-stages") != bool(ENTRY.search(text)):
            faults.append(f"{path}: {'no entry point, and in' if room == 'slang-stages' else 'an entry point, and not in'} slang-stages")
        for module in re.findall(r"^\s*module\s+(\w+)\s*;", text, re.MULTILINE):
            if module in names:
                faults.append(f"{path}: a second module {module}, beside {names[module]}")
            names[module] = path
    if len(imports) < 50:
        faults.append(f"only {len(imports)} kernel files were read")
    return imports


def main():
    source = pathlib.Path(sys.argv[1])
    rooms = rooms_of(pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else pathlib.Path(__file__).with_name("layers.txt"))
    faults = []
    for what, read in (("includes", read_cpp), ("imports", read_slang)):
        way = circle(read(source, rooms, faults))
        if way:
            faults.append(f"a circle of {what}: " + " -> ".join(way))
    read_names(source, rooms, faults)
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
