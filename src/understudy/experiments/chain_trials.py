"""Chains of transmissions as trials (§4.5.5.2): what the human teacher shows is passed on from robot to robot."""

from collections import Counter
from collections.abc import Sequence
from typing import Annotated

from pydantic import Field

from understudy.behaviors import installed_skills
from understudy.experiments.chains import chain_of, steps_in_order
from understudy.experiments.document import Options
from understudy.experiments.summary import Measured
from understudy.experiments.teaching import reference
from understudy.experiments.transfer import transfer_limit
from understudy.experiments.trial import Trial
from understudy.experiments.unit import Unit
from understudy.learning import learn
from understudy.sessions import teach
from understudy.teaching import CAREFUL, NAIVE

__all__ = ["ChainOptions", "chain_trial", "measured_limit"]


class ChainOptions(Options):
    """What a row of chains takes.

    Attributes:
        naive: the robots teach as if nobody followed.
        most: transmissions after which a chain is cut off.
    """

    naive: bool = False
    most: Annotated[int, Field(ge=1)] = 20


def chain_trial(unit: Unit) -> Trial:
    """A chain of transmissions. A success is one that was cut off before it failed; ``details`` tell how far it came.

    The first robot learns from the world's own teacher, with the trial's seed. If that fails already, nothing was
    passed on, and the chain has failed.

    Raises:
        WorldError: the world has no teacher.
        LearningError: nothing can be learned from that teacher.
    """
    options, skills = ChainOptions.model_validate(unit.options), installed_skills()
    settings = unit.experiment.document.learning.settings
    first = learn(teach(unit.place, skills, seed=unit.seed, settings=settings).demonstration, settings).network
    if steps_in_order(first) != steps_in_order(reference(unit)):
        return unit.trial(ending="unfinished", problems=("the human teacher taught another task",))
    chain = chain_of(
        unit.experiment.name,
        first,
        unit.place,
        skills,
        seed=unit.seed,
        manner=NAIVE if options.naive else CAREFUL,
        most=options.most,
        settings=settings,
        limit_s=unit.limit_s,
    )
    verdicts = [one.passed.verdict for one in chain.transmissions]
    problems = [f"transmission {chain.limit + 1}: {chain.transmissions[-1].problem}"] if chain.failed else []
    return unit.trial(
        ending="taught",
        time_s=round(sum(one.passed.demonstration.span.duration for one in chain.transmissions), 3),
        problems=tuple(problems),
        collisions=dict(sum((Counter(verdict.collisions) for verdict in verdicts), Counter())),
        grazes=dict(sum((Counter(verdict.grazes) for verdict in verdicts), Counter())),
        details={"transmissions": chain.limit},
    )


def measured_limit(trials: Sequence[Trial]) -> Measured:
    """The mean of the task transfer limit, with the interval that the dissertation has, of 98 %."""
    found = transfer_limit([(trial.details.get("transmissions", 0), not trial.success) for trial in trials])
    told = f"mean {found.mean:.1f} ({found.successes} transmissions, {found.failures} of {found.chains} chains failed)"
    return Measured(value=found.mean, told=told, sure=f"98 %: {found.low:.1f} to {found.high:.1f}")
