"""How a recorded run ended, as its own trace tells it."""

from dataclasses import dataclass

from understudy.recording.recording import Recording

__all__ = ["Outcome", "outcome_of"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """How a run ended.

    Attributes:
        done: the task was done.
        time_s: when the run ended, since its first moment; after a task was done, the moment when it was.
        reason: why the task was not done; empty if it was.
        achieved: components with the moments at which they were achieved, on the trace's clock, in that order.
    """

    done: bool
    time_s: float
    reason: str
    achieved: tuple[tuple[str, float], ...]

    def __str__(self) -> str:
        """``done after 52.3 s``; ``not done: the time limit of 300 s``."""
        return f"done after {self.time_s:.1f} s" if self.done else f"not done: {self.reason}"


def outcome_of(recording: Recording) -> Outcome:
    """How a recorded run ended.

    A run that has neither an end nor a reason for it was interrupted, or its file was cut.

    Raises:
        RecordingError: the recording is damaged.
    """
    first = next(recording.observations(images=False), None)
    begin_s = first.time_s if first else 0.0
    last_s = recording.info.duration_s
    done, time_s, reason = False, last_s, f"it breaks off at {last_s:.1f} s"
    achieved = []
    for event in recording.events():
        match event.get("kind"):
            case "complete":
                done, time_s, reason = True, float(event["time_s"]) - begin_s, ""
            case "stopped" if not done:
                time_s, reason = float(event["time_s"]) - begin_s, str(event.get("reason", "it was stopped"))
            case "achieved":
                achieved.append((str(event.get("component", "")), float(event["time_s"])))
            case _:
                pass
    return Outcome(done=done, time_s=time_s, reason=reason, achieved=tuple(achieved))
