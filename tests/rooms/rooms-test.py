"""Reads the includes of the library, the harness and the command, and says which of them layers.txt does not allow.

usage: rooms-test.py SOURCE [LAYERS]
"""

import pathlib
import re
import sys

INCLUDE = re.compile(r'^\s*#\s*include\s*(?:"([^"]+)"|<(tessera/[^>]+)>)', re.MULTILINE)
# A public header is read by programs that have none of these.
FOREIGN = re.compile(r'^\s*#\s*include\s*[<"](vulkan|OpenMesh|OpenImageIO|Imath|OpenEXR|nlohmann|CLI|fmt|tbb|toml\+\+)[/.]', re.MULTILINE)


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
        for target in includes.get(path, ()):
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


def main():
    source = pathlib.Path(sys.argv[1])
    layers = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else pathlib.Path(__file__).with_name("layers.txt")
    rooms = rooms_of(layers)
    faults, includes = [], {}
    for top in ("host", "datasets", "experiments/harness"):
        for file in sorted((source / top).rglob("*")):
            path = file.relative_to(source).as_posix()
            if file.suffix not in (".h", ".cpp") or "third-party" in path:
                continue
            room = room_of(path, rooms)
            if room is None:
                faults.append(f"{path}: in no room of {layers.name}")
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
    way = circle(includes)
    if way:
        faults.append("a circle of includes: " + " -> ".join(way))
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
