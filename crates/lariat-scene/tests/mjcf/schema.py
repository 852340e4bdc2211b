"""Writes schema.txt: elements, after their parents, and attributes of MuJoCo's schema.

pip install mujoco==3.17.0 && python schema.py
"""

import ctypes
import re
from pathlib import Path

import mujoco


def main() -> None:
    library = ctypes.CDLL(str(next(Path(mujoco.__file__).parent.glob("libmujoco.so*"))))
    buffer = ctypes.create_string_buffer(1 << 20)
    library.mj_printSchema(None, buffer, len(buffer), 0, 0)
    rows: dict[str, set[str]] = {}
    stack: list[str] = []
    for line in buffer.value.decode().splitlines():
        found = re.match(r"^( *)(\(world\)body|\w+) \(.\)\s*(.*)$", line)
        if found:
            name = found[2].removeprefix("(world)")
            stack = [*stack[: len(found[1]) // 3], name]
            path = "/".join(stack[-2:]) if len(stack) > 2 else name
            rows.setdefault(path, set()).update(found[3].split())
        elif line.strip():
            rows[path].update(line.split())
    text = "".join(f"{path}: {' '.join(sorted(names))}\n" for path, names in rows.items())
    note = f"# Elements and attributes of MuJoCo {mujoco.__version__}, as mj_printSchema prints them: schema.py\n"
    (Path(__file__).parent / "schema.txt").write_text(note + text)


if __name__ == "__main__":
    main()
