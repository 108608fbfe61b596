"""Goals of the robot's own skills, and planning problems of nobody's."""

from hypothesis import strategies as st

from understudy.behaviors import Fact
from understudy.planning import Operator

BOXES, TARGETS = ("orange", "pink"), ("green", "pink")
THINGS = {"box": BOXES, "target": TARGETS}

box, target = st.sampled_from(BOXES), st.sampled_from(TARGETS)
facts = st.one_of(
    st.just(Fact("gripper_empty")),
    st.builds(lambda one: Fact("holding", (one,)), box),
    st.builds(lambda one: Fact("near", (one,)), target),
    st.builds(lambda one: Fact("visited", (one,)), target),
    st.builds(lambda one, other: Fact("carried", (one, other)), box, target),
)
goals = st.lists(facts, min_size=1, max_size=3, unique=True).map(tuple)

WORDS = tuple(map(Fact, "abcde"))
_some = st.frozensets(st.sampled_from(WORDS), max_size=2)


@st.composite
def operators(draw):
    """A few operators over five facts, each of which has one of the facts that it gives as its goal."""
    found = []
    for number in range(draw(st.integers(1, 6))):
        goal = draw(st.sampled_from(WORDS))
        keeps, gives = draw(st.frozensets(st.sampled_from(WORDS), max_size=1)), draw(_some) | {goal}
        found.append(
            Operator(
                name=f"Skill{number}",
                skill=f"Skill{number}",
                parameters={},
                goal=goal,
                needs=draw(_some) | keeps,
                keeps=keeps,
                gives=gives,
                ends=draw(_some) - gives,
            )
        )
    return tuple(found)


problems = st.tuples(operators(), _some, st.frozensets(st.sampled_from(WORDS), min_size=1, max_size=3))
