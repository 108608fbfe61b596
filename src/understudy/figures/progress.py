"""How a run went, over time (Figure 4.14): a row for every step, those of a network below the network's own."""

from collections.abc import Callable, Iterable, Sequence

from matplotlib.figure import Figure

from understudy.execution.trace import Event, State
from understudy.figures.chart import BAR, Chart, Drawing, KeyItem, Row, TimeAxis, bar_colors
from understudy.figures.labels import label_of
from understudy.figures.numbering import letters_of, numbers_of
from understudy.figures.sheet import Sheet
from understudy.figures.style import FAINT, INK, MUTED, PAPER, SMALL, text_width
from understudy.network import Nab, Network

__all__ = ["draw_progress", "rows_of"]

_EXECUTING = "#c6cdd6"
_SHOWN = "#f3ecdc"
_GOAL = 8.0
"""Height of the bar that shows when a goal held; the robot's doings fill the row behind it."""
_INDENT = 11.0


def draw_progress(
    network: Network,
    events: Iterable[Event],
    duration: float,
    *,
    begin: float = 0.0,
    title: str = "progress",
    subtitle: str = "",
) -> Figure:
    """Draw a run: for every step when its goal held, when it was being done, and when it was achieved.

    Args:
        network: the task.
        events: the run's trace.
        duration: of the run, seconds.
        begin: the first moment on the trace's clock.
        title: above.
        subtitle: below it, for example why the task was not done.
    """
    events = sorted(events, key=lambda event: event.time_s)
    rows = rows_of(network)
    mine: dict[str, list[Event]] = {path: [] for path in rows}
    for event in events:
        if event.component in mine:
            mine[event.component].append(event)
    told = {path: _told(mine[path], begin) for path in rows}
    right = max((text_width(text, 9.0) for text, _ in told.values()), default=0.0)
    axis = TimeAxis.beside(list(rows.values()), 0.0, duration)
    chart = Chart(
        axis,
        list(rows.values()),
        title=title,
        subtitle=subtitle,
        above=10.0,
        right=max(58.0, right + 16.0),
        key=_key(events),
    )
    sheet = chart.sheet
    for start, end in _lessons(events, begin, duration):
        _lesson(sheet, axis.x(start), axis.x(end), chart.top, chart.bottom)
    for (path, row), middle in zip(rows.items(), chart.middles, strict=True):
        states = [(event.time_s - begin, event.detail.get("state")) for event in mine[path] if event.kind == "state"]
        for start, end, state in _spells(states, duration):
            _doing(sheet, axis.x(start), axis.x(end), middle, str(state))
        goals = [
            (event.time_s - begin, bool(event.detail.get("holds"))) for event in mine[path] if event.kind == "goal"
        ]
        for start, end, holds in _spells(goals, duration):
            if holds:
                fill, border = bar_colors(row.label) if row.label.color else (MUTED, MUTED)
                width = max(axis.x(end) - axis.x(start), 1.2)
                sheet.rectangle(axis.x(start), middle - _GOAL / 2, width, _GOAL, fill=fill, border=border, z=3)
        for event in mine[path]:
            if event.kind == "achieved":
                _diamond(sheet, axis.x(event.time_s - begin), middle, found=not event.detail.get("on_purpose", True))
            elif event.kind in _MARKS:
                _MARKS[event.kind](sheet, axis.x(event.time_s - begin), middle)
            elif _is_bad(event):
                _bad(sheet, axis.x(float(event.detail["said_s"]) - begin), middle)
        text, quiet = told[path]
        sheet.text(sheet.width - 26.0, middle, text, color=MUTED if quiet else INK, align="right")
    for path, component in network.walk():
        if isinstance(component, Nab):
            middle = chart.middles[list(rows).index(path)]
            _beginnings(sheet, axis, mine[path], begin, letters_of(component), middle)
    for event in events:
        if event.kind == "complete":
            x = axis.x(event.time_s - begin)
            sheet.line([(x, chart.top - 4), (x, chart.bottom)], color=INK, width=1.0, z=2.5)
            text = f"complete {event.time_s - begin:.1f} s"
            sheet.text(x + 1.0, chart.top - 10.0, text, size=SMALL, weight="bold", align="right")
    sheet.text(sheet.width - 26.0, chart.top - 10.0, "achieved", size=SMALL, color=MUTED, align="right")
    return chart.figure


def rows_of(network: Network, *, below: float = 0.0) -> dict[str, Row]:
    """A row for every component, by path, in the order of their numbers; parts stand below what they are parts of.

    Args:
        network: the task.
        below: how much room each takes below its bar, points.
    """
    return {
        path: Row(label=label_of(network.by_path[path]), number=number, indent=_INDENT * number.count("."), below=below)
        for path, number in numbers_of(network).items()
    }


def _told(events: Sequence[Event], begin: float) -> tuple[str, bool]:
    """What stands to the right of a row, and whether it is no achievement."""
    moments = [event.time_s - begin for event in events if event.kind == "achieved"]
    if moments:
        times = f"{len(moments)}×, last " if len(moments) > 1 else ""
        return f"{times}{moments[-1]:.1f} s", False
    skipped = any(event.kind == "state" and event.detail.get("state") == State.SKIPPED for event in events)
    return ("skipped", True) if skipped else ("", True)


def _spells(changes: Sequence[tuple[float, object]], until: float) -> list[tuple[float, float, object]]:
    """From each change to the next, and from the last one to the end; what is told again is no change."""
    changes = [one for index, one in enumerate(changes) if index == 0 or one[1] != changes[index - 1][1]]
    ends = [*(moment for moment, _ in changes[1:]), max([until, *(moment for moment, _ in changes[-1:])])]
    return [(start, end, value) for (start, value), end in zip(changes, ends, strict=False)]


def _beginnings(
    sheet: Sheet, axis: TimeAxis, events: Sequence[Event], begin: float, letters: dict[str, str], middle: float
) -> None:
    """The rounds of a loop and the cases that are begun, each by its number and letter, where there is room for it."""
    moments: dict[float, str] = {}
    for event in events:
        moment = event.time_s - begin
        if event.kind == "round":
            moments[moment] = f"{event.detail.get('number')}{moments.get(moment, '')}"
        elif event.kind in ("case", "switch"):
            moments[moment] = moments.get(moment, "") + letters.get(
                str(event.detail.get("case", event.detail.get("to"))), ""
            )
    free = axis.left
    for moment, text in sorted(moments.items()):
        x = axis.x(moment)
        sheet.line([(x, middle - BAR / 2), (x, middle + BAR / 2)], color=INK, width=1.2, cap="butt", z=4)
        width = text_width(text, SMALL, "bold")
        if x + 3.0 >= free and x + 3.0 + width < axis.right:
            sheet.text(x + 3.0, middle, text, size=SMALL, weight="bold", halo=2.0)
            free = x + width + 6.0


def _doing(sheet: Sheet, left: float, right: float, middle: float, state: str) -> None:
    top, width = middle - BAR / 2, right - left
    match state:
        case State.EXECUTING:
            sheet.rectangle(left, top, width, BAR, fill=_EXECUTING, z=2)
        case State.SEARCHING:
            sheet.rectangle(left, top, width, BAR, fill=PAPER, border=FAINT, hatch="/////", line=0.6, z=2)
        case State.INHIBITED:
            sheet.rectangle(left, top, width, BAR, fill=PAPER, border=FAINT, hatch="....", line=0.6, z=2)
        case State.SKIPPED:
            sheet.line([(left, middle), (right, middle)], color=MUTED, width=1.2, dashes=(1.2, 2.2), cap="butt")
        case _:
            pass


def _diamond(sheet: Sheet, x: float, y: float, *, found: bool) -> None:
    corners = [(x, y - 6.5), (x + 5.2, y), (x, y + 6.5), (x - 5.2, y)]
    sheet.polygon(
        corners, fill=PAPER if found else INK, border=INK if found else PAPER, line=1.2 if found else 0.8, z=5
    )


def _called(sheet: Sheet, x: float, y: float) -> None:
    """A duty is called."""
    sheet.polygon([(x - 4.0, y - 8.0), (x + 4.0, y - 8.0), (x, y - 2.5)], fill=PAPER, border=INK, line=1.1, z=4.5)


def _timed_out(sheet: Sheet, x: float, y: float) -> None:
    """A component runs out of its time."""
    for slope in (1, -1):
        sheet.line([(x - 3.6, y - 3.6 * slope), (x + 3.6, y + 3.6 * slope)], color=INK, width=1.6, z=4.5)


def _is_bad(event: Event) -> bool:
    """Whether a teacher's BAD took the step out."""
    return event.kind == "corrected" and event.detail.get("word") == "BAD" and "note" not in event.detail


def _bad(sheet: Sheet, x: float, y: float) -> None:
    """The step is taken out."""
    sheet.rectangle(x - 5.0, y - 5.0, 10.0, 10.0, fill=PAPER, border=INK, line=1.1, z=5)
    for slope in (1, -1):
        sheet.line([(x - 3.0, y - 3.0 * slope), (x + 3.0, y + 3.0 * slope)], color=INK, width=1.4, z=5.5)


def _lessons(events: Sequence[Event], begin: float, until: float) -> list[tuple[float, float]]:
    """From each COME to its GO, or to the end."""
    changes = [
        (event.time_s - begin, event.kind == "suspended") for event in events if event.kind in ("suspended", "resumed")
    ]
    return [(start, end) for start, end, shown in _spells(changes, until) if shown]


def _lesson(sheet: Sheet, left: float, right: float, top: float, bottom: float) -> None:
    """The run is suspended, while the teacher shows something: no step is executed, though goals may hold."""
    sheet.rectangle(left, top, right - left, bottom - top, fill=_SHOWN, z=2.5)


_MARKS: dict[str, Callable[[Sheet, float, float], None]] = {"called": _called, "timeout": _timed_out}


def _goal_sample(sheet: Sheet, x: float, y: float) -> None:
    sheet.rectangle(x, y - _GOAL / 2, 20.0, _GOAL, fill=MUTED)


def _doing_sample(state: State) -> Drawing:
    return lambda sheet, x, y: _doing(sheet, x, x + 20.0, y, state)


def _diamond_sample(found: bool) -> Drawing:
    return lambda sheet, x, y: _diamond(sheet, x + 10.0, y, found=found)


def _mark_sample(kind: str) -> Drawing:
    lower = 5.0 if kind == "called" else 0.0  # it stands above the middle of its row
    return lambda sheet, x, y: _MARKS[kind](sheet, x + 10.0, y + lower)


def _lesson_sample(sheet: Sheet, x: float, y: float) -> None:
    _lesson(sheet, x, x + 20.0, y - BAR / 2, y + BAR / 2)


def _bad_sample(sheet: Sheet, x: float, y: float) -> None:
    _bad(sheet, x + 10.0, y)


def _beginning_sample(sheet: Sheet, x: float, y: float) -> None:
    sheet.line([(x + 4.0, y - BAR / 2), (x + 4.0, y + BAR / 2)], color=INK, width=1.2, cap="butt")
    sheet.text(x + 7.0, y, "2a", size=SMALL, weight="bold")


def _key(events: Sequence[Event]) -> list[KeyItem]:
    """What always may occur, and what does."""
    states = {event.detail.get("state") for event in events if event.kind == "state"}
    kinds = {event.kind for event in events}
    key: list[KeyItem] = [
        (_goal_sample, "its goal holds"),
        (_doing_sample(State.EXECUTING), "executing"),
        (_doing_sample(State.SEARCHING), "searching"),
    ]
    if State.INHIBITED in states:
        key.append((_doing_sample(State.INHIBITED), "inhibited"))
    if State.SKIPPED in states:
        key.append((_doing_sample(State.SKIPPED), "skipped"))
    key += [
        (_diamond_sample(False), "achieved on purpose"),
        (_diamond_sample(True), "already so when its turn came"),
    ]
    if kinds & {"round", "case", "switch"}:
        key.append((_beginning_sample, "round or case begins"))
    if "called" in kinds:
        key.append((_mark_sample("called"), "called"))
    if "timeout" in kinds:
        key.append((_mark_sample("timeout"), "out of time"))
    if "suspended" in kinds:
        key.append((_lesson_sample, "being shown, COME to GO"))
    if any(map(_is_bad, events)):
        key.append((_bad_sample, "BAD: taken out"))
    return key
