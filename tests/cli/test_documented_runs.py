"""The commands of docs/runs.md, run as they stand there."""

import re
import shlex
from pathlib import Path

from .program import understudy

PAGE = Path(__file__).parents[2] / "docs" / "runs.md"


def test_every_command_of_the_page_does_what_it_says(tmp_path: Path) -> None:
    text = PAGE.read_text(encoding="utf-8")
    lines = [line for block in re.findall(r"```sh\n(.*?)```", text, re.DOTALL) for line in block.splitlines()]
    assert len(lines) == 7
    outputs = []
    for line in lines:
        command, *arguments = shlex.split(line)
        assert command == "understudy"
        outputs.append(understudy(*arguments, folder=tmp_path, expect=int("--pause-at" in arguments)).stdout)
    told = re.findall(r"```text\n(.*?)```", text, re.DOTALL)
    for output, shown in zip(outputs[2:4], told, strict=True):
        # Another processor may round otherwise, and be a tenth of a second later.
        assert re.sub(r"[\d.]+ s", "T", output) == re.sub(r"[\d.]+ s", "T", shown)
    code = re.search(r"```python\n(.*?)```", text, re.DOTALL)
    assert code is not None
    program = code[1].replace("understudy-out", str(tmp_path / "understudy-out"))
    exec(compile(program, str(PAGE), "exec"), {})
