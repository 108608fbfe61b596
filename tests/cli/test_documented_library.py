"""The commands of docs/library.md, run as they stand there, one after the other."""

import re
from pathlib import Path

from .test_library import Terminal, terminal

__all__ = ["terminal"]

PAGE = Path(__file__).parents[2] / "docs" / "library.md"


def test_every_command_of_the_page_does_what_it_says(terminal: Terminal) -> None:
    text = PAGE.read_text(encoding="utf-8")
    lines = [line for block in re.findall(r"```sh\n(.*?)```", text, re.DOTALL) for line in block.splitlines()]
    told = {line: terminal(line.partition("#")[0].removeprefix("understudy ")) for line in lines}
    (shown,) = re.findall(r"```text\n(.*?)```", text, re.DOTALL)
    # Another processor may round otherwise, and be a tenth of a second later.
    practised = told["understudy practice visits --world practice"]
    assert re.sub(r"[\d.]+ s", "T", practised) == re.sub(r"[\d.]+ s", "T", shown)
    assert "fetch  @1" in told["understudy tasks list"]
    library = terminal.library()
    assert [str(one) for one in library.sittings("fetch")] == ["demonstration 1", "run 1"]
    one, _, three, four, five = library.history("visits")
    assert (four.document, five.document) == (three.document, one.document)
    assert library.revision("visits") == five
