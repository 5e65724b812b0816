"""What people say around a request: courtesy, procedure words of the radio, spoken filling. Templates, no logic.

Each frame leaves what is asked for as it is. Whatever could change it (a condition, a time, a manner) stays out.
"""

from collections.abc import Iterator

from crew.contracts.language.templates import expansions

FRAMES: tuple[str, ...] = (
    "(i would|i'd|we would|we'd) be (|very |most |so |really |much )"
    "(grateful|obliged|thankful|happy|glad|pleased|delighted) (if|if you|if you could|if you would)",
    "(would it be|is it|will it be) (|at all )(possible|all right|alright|ok|okay|fine|too much trouble) "
    "(to|for you to|if|if you|if you could|if you would)",
    "(when|whenever|if) you (have|get|find) (a moment|a minute|a second|a sec|time|the time|a chance|the chance)",
    "(when|whenever) you (can|are ready|are free|like)",
    "(at your convenience|in your own time|by all means|by any chance)",
    "(be|would you be|could you be) (a dear|a darling|a love|a sport|an angel|a friend) and",
    "(could|can|may|might) (i|we) (|please |kindly )(ask|beg|request|bother|trouble|get) you to",
    "(i|we) (must|have to|would|want to|would like to|would just like to) (ask|request|beg|tell|instruct) you to",
    "(i|we) (want|need|wish|would like|require|would prefer) that",
    "(i'd|we'd) (like|prefer) that",
    "(i'm|i am|we're|we are) (needing|wanting)",
    "make (|it |sure |so |it so )that",
    "(it is|it's) (|very |really )(needed|necessary|required|important|essential|imperative) (to|that|for you to)",
    "(it would be|that would be|it is) (|very |most |so )(kind|nice|good|helpful) of you (to|if you could)",
    "(may|might|could|can) (i|we) ask (|you )for (a|an|the)",
    "do you (think|suppose|reckon) you (could|can|might|would)",
    "would you (care|be willing|be so kind as|be good enough) to",
    "(you know what|i tell you what|tell you what|the thing is|long story short|to be honest|if i may)",
    "(i'm|i am|we're|we are) (going to|definitely going to) (need|want)",
)
"""Said before a request, or between its parts."""

OPENINGS: tuple[str, ...] = (
    "(dear me|oh dear|my goodness|goodness|goodness me|heavens|oh my|well now|now now|all right)",
    "(i'm|i am|we're|we are) (|so |very |really |quite |a bit )"
    "(thirsty|hungry|tired|cold|busy|worried|in a hurry|running late|new here)",
    "(roger|roger that|copy|copy that|affirmative|affirm|wilco|break|break break|radio check|say)",
    "next (up|job|task|order) (|is)",
)
"""Said where a clause begins."""

TAGS: tuple[str, ...] = (
    "(will|would|won't|can|could|can't|wouldn't|couldn't) you",
    "(ok|okay|all right|alright|right|yes|yeah|eh|huh|got it|understood|clear|is that clear)",
    "(is that|if that's|if that is|if it is|if it's) (ok|okay|all right|alright|fine|possible|not too much trouble)",
    "(that would be|that'd be|it would be) (great|nice|lovely|perfect|wonderful|kind|all)",
    "(that's|that is) (all|it|everything)",
    "there's a (dear|love|good boy|good girl|good lad|good dog)",
    "(thanks so much|thank you so much|much obliged|much appreciated|thanking you|thank you kindly)",
    "(over|out|over and out|how copy|do you copy|acknowledge|acknowledged|roger|wilco|stand by|standing by)",
    "and stand by",
)
"""Said where a sentence ends, and nothing follows."""

PRESENTED: tuple[str, ...] = (
    "(we have|we've|we have got|we've got|we got|we are missing|we're missing|we lost|we have lost|we've lost) (a|an)",
)
"""Said in front of the person who is to be found."""

WHEREABOUTS: tuple[str, ...] = (
    "(|was |were )last (seen|spotted|heard from|heard of)",
    "(is|must be|should be|is probably|might be) somewhere",
)
"""Said behind that person."""

BEFORE_A_MARK = frozenset(("copy", "say", "break", "roger", "affirm"))
"""Openings that are verbs without a mark behind them."""
AFTER_A_MARK = frozenset(("over", "out", "right", "clear", "roger", "yes", "eh", "huh"))
"""Tags that would belong to what stands in front of them, were there no mark between."""


def phrases(templates: tuple[str, ...]) -> Iterator[str]:
    """Every wording, with single blanks."""
    return (" ".join(wording.split()) for template in templates for wording in expansions(template))
