"""Wordings that say the same as a plainer one, which the reader knows. Templates, no logic.

A rewriting never adds a name, a place, a figure or a negation, and never takes one away. `(a|b)` is a choice.
"""

from functools import cache

from crew.contracts.language.wordings import Wordings, of_templates

Words = tuple[str, ...]

_IF = "(if|whether)"
_ANYONE = "(anyone|anybody|someone|somebody|anyone out|anybody out|someone out|somebody out)"
_IS = "(there is|there's|there are|there might be|there could be)"

_EYES = "(eyes on|eyes upon|sight of|a visual on|visual on|a visual of|visual contact with|eyes-on|a sighting of)"

REWRITES: tuple[tuple[str, str], ...] = (
    (
        f"(see|check|look|find out|make sure|tell me|let me know|have a look|take a look) {_IF} {_IS} {_ANYONE}",
        "find anyone",
    ),
    (f"(see|check|look|find out|tell me|let me know) {_IF} {_ANYONE} (is|might be|could be)", "find anyone"),
    ("(see|check|find out|tell me) who (is|might be|could be)", "find anyone"),
    ("(see|check|look|find out|tell me) (if|whether) you (can|could) (find|see|spot|locate)", "find"),
    ("see if you (can|could)", "please"),
    ("(can|could|would|will) (u|ya)", "can you"),
    ("ever so", "so"),
    ("in search of", "to find"),
    ("(whoever|whomever) (turns up|shows up|it is|that is|is found|is located|is spotted|appears)", "whoever you find"),
    (
        "(the|that) (person|casualty|victim) (|that |who |whom )(it|he|she|you|they) (finds|find|found|encounters|"
        "locates|spots|sees|discovers|has found)",
        "the person",
    ),
    ("(to|at) where (it|he|she|you) (started|came|set off|began|set out)(| from)", "to base"),
    ("(make|find|work|wend) (its|his|her|your) way (back|over|round|across|straight|up|down|home) to", "go to"),
    (
        "(take up|take|assume|get into|get in) (its|a|your|their|his|her) (position|place|post|station) "
        "(at|in|by|near)",
        "go to",
    ),
    *(
        (f"{word} , (like|kind of|sort of|kinda|sorta) ,", word)
        for word in ("i'm", "i am", "we're", "and", "to", "the", "it's", "is", "could you", "can you", "on", "in", "at")
    ),
    ("(would you|do you|will you) mind (having|letting)", "please let"),
    ("(i'd|i would|we'd|we would) (appreciate|like|love) having", "please have"),
    ("(come|comes|coming) to a (stop|halt|standstill|full stop)", "stop"),
    *(
        (f"(i'm|i am|we're|we are) afraid (|that ){who}", who)
        for who in ("i", "i'm", "i am", "we", "we're", "my", "i've")
    ),
    ("(i'll|i will|we'll|we will|i shall) (need|want|require)", "i need"),
    (
        "(i'd|i would|we'd|we would) be (|so |very |most |really )(grateful|glad|happy|pleased|thankful) to see",
        "i want",
    ),
    (
        "(that's|that is|is|it's|this is) where (i|we|i'd|we'd) (want|need|would like|should like|like|would want)",
        "i want",
    ),
    ("(could|can|may|might) (i|we) (trouble|bother|ask|beg) (the|that|your)", "tell the"),
    ("(let's have|let us have) you", "please"),
    ("(flight|flying|search|cruise|cruising|operating|working) (altitude|height|level)", "altitude"),
    (
        "what (i'd like|i would like|we'd like|we would like|we need|we want|i'd love|i'm after|we're after|i'm asking|"
        "i ask|we ask) (is|now is) (for|)",
        "i want",
    ),
    ("(plz|pleez|plese)", "please"),
    ("(why don't|why do not|why not) (we|you)", "please"),
    ("(is|is it|would it be) possible (for|that) (you|we|the robots) (to|can|could)", "please"),
    ("is possible (to|that you|you to|you)", "please"),
    ("(any|is there any|is there a) chance (you could|you can|that you could|we could|you would)", "please"),
    ("how about (|we |you |just )", "please"),
    ("(hello|hi|hey) there", "hello"),
    ("(i'd|i would|we'd|we would) (love|really like|very much like)", "i would like"),
    ("(grab|get|fetch|bring|hand|pass|give) me over", "bring me"),
    ("(i'd like|i would like|i want|we'd like|we would like|we want) to see (the|our|your|my)", "i want the"),
    ("(we'd|you'd|it'd) better", "please"),
    ("(you|we|they) (might|may) (want|like|wish) to", "please"),
    ("(off|away|onward|onwards) to", "to"),
    ("grab me", "fetch me"),
    ("(off you go|off we go|off with you|go on) to", "go to"),
    ("(have|take) (a|another|one more) (quick|good|close|careful|thorough|proper) look", "have a look"),
    ("(it is|it's) (needed|required|necessary|important|essential) to", "it is necessary to"),
    ("(have|get|ask|tell) (someone|somebody|anyone) to", "please"),
    ("have (someone|somebody|anyone)", "please"),
    ("(|i'm |i am |we're |we are )going to (need|want)", "i need"),
    ("(may|might|could|can) (i|we) (|please |kindly |possibly )have", "i want"),
    ("(it is|it's) needed that", "it is needed that"),
    ("(it is|it's) required that", "it is required that"),
    ("(it is|it's) (necessary|important|essential) that", "it is important that"),
    ("is (needed|required|necessary|important|essential) (to|that)", "it is necessary to"),
    ("(i'd|i would|we'd|we would) be (|so |very |most )(grateful|thankful|happy|glad|pleased|obliged) for", "i want"),
    ("(|please )arrange for", "please"),
    ("see that", "see to it that"),
    ("so (wanted|needed)", "needed"),
    ("(i|we) would like to know where", "where"),
    ("(do you know|tell me|do we know|let me know|show me|find out) where", "where"),
    ("(in need of|short of|crying out for|asking for|calling for)", "needs"),
    ("(is|are) (in need of|short of|asking for|calling for|requesting)", "needs"),
    ("(asks for|calls for|requires|requests|could do with|could use)", "needs"),
    (
        "(has|have) (|just |now )(asked for|called for|requested|ordered|run out of|phoned for|radioed for|put in for|"
        "sent for|been asking for|asked to have)",
        "needs",
    ),
    ("(make your way|make its way|find your way|get yourself|take yourself|betake yourself) to", "go to"),
    ("(along|over|out|across|off|round|around|straight|directly|right|all the way|on over|through) to", "to"),
    ("(along|out|across|straight|directly|right|all the way) (into|towards)", "to"),
    ("back (at|in|on)", "at"),
    ("report back", "report"),
    ("back here", "here"),
    ("on top of", "on"),
    ("(report|tell me|say|show me) what you (find|see|saw|found)", "report"),
    (
        "(report|tell me|let me know|say|shout) (if|when|whether|once|as soon as) (you|it) (find|finds|see|sees|spot|"
        "spots) "
        "(anyone|anybody|someone|somebody|anything|something|him|her|them)",
        "report",
    ),
    ("(return|give|provide) (the|his|her|their) (coordinates|position|location|whereabouts)", "report"),
    ("(determine|establish|identify|obtain|work out) (the|his|her|their) (position|location|whereabouts) of", "find"),
    ("(identify|determine|establish|work out|figure out) where", "where"),
    (
        "(anyone|anybody|someone|somebody) (who needs help|in need of help|in trouble|in distress|in need|who is lost|"
        "who is hurt|who is in trouble|who is missing|who might be lost|who may be lost)",
        "anyone",
    ),
    ("(whoever|whomever) is (out there|in there|over there)", "whoever is there"),
    ("(move|get|bring|take|drive) (yourself|itself|himself|yourselves) to", "go to"),
    ("(to|over to|into) (that|this|the same) (position|location|spot|place|point|room|table|area|station)", "there"),
    ("(follow|follow on|come along|come up|move up|close up) to", "go to"),
    ("(i|we) require", "i need"),
    ("require", "need"),
    (
        "(you're|you are|your presence is) (wanted|needed|required|requested|expected|awaited) (here|over here)",
        "come here",
    ),
    ("(come|go|return|get over) (by|at|beside|next to|over to|up to) me", "come to me"),
    ("(at|to) (my|our) (position|location|current position|current location)", "to me"),
    (f"(has|have|has got|have got|has had) {_EYES}", "has found"),
    (f"(get|lay|gain|obtain|establish) {_EYES}", "find"),
    ("(has|have) (spotted|sighted|seen|detected|identified)", "has found"),
    (
        "fly (around|about|round|across|through|all over|all around) (everywhere|the whole area|the entire area)",
        "fly over everywhere",
    ),
    ("(mount|stage|launch|set up|run) (a|the|another) search", "do a search"),
    ("seek (the|a|our|my|that|this)", "find the"),
    ("(reach|slip) me", "hand me"),
    ("fly (the|your|a) (search|sweep|survey)", "do a search"),
)
"""What is said, and what it is read as."""

BEFORE_A_PLACE: tuple[tuple[str, str], ...] = (
    ("(over|down|up|out|away) (in|at|on)", "in"),
    ("(destination|destination is|going to|bound for|destined for|addressed to|drop at)", "to"),
    ("(you're|you are) (going|headed|heading|off|bound|to go) (to|for)", "go to"),
    ("(standing|waiting|parked|positioned|stationed|sitting|ready|placed|stood) (at|in|by|on)", "at"),
    ("(down|up|back down|back up|home|back home|on home|off|on down) to", "to"),
    ("(over|across|round|out|down|back) (in|at)", "in"),
    ("walkies to", "go to"),
    ("back", "to"),
    ("(goes|belongs|should go|must go|has to go|needs to go) (on|onto)", "put on"),
    ("(set off|set out|start out|start off|leave|depart|make) for", "go to"),
    ("(end up|wind up|finish up|arrive|be dropped off|be delivered|turn up) (in|at|on)", "go to"),
)
"""The same, only in front of a place's name."""

BEFORE_A_GOAL: tuple[tuple[str, str], ...] = (
    ("(make|head|aim) for", "go to"),
    ("(standing|waiting|parked|positioned|stationed|placed) (at|by)", "at"),
    ("(you're|you are|your presence is) (wanted|needed|required|requested|expected|awaited) (at|in|by)", "go to"),
    ("respond to", "go to"),
)
"""The same, only in front of a place's name or a point."""

DONE_AT: dict[str, tuple[str, ...]] = {
    "base": ("rtb",),
    "charging": (
        "charge",
        "recharge",
        "charge up",
        "charge itself",
        "charge yourself",
        "recharge itself",
        "recharge yourself",
    ),
}
"""Verbs, at the end of a clause, for going to a place of this name, in a crew that has it."""

BEFORE_A_ROBOT: tuple[tuple[str, str], ...] = (
    ("(take|bring|get|position|order|park|station|route|put|place|deploy|redeploy|reposition|relocate)", "send"),
)
"""The same, only in front of a robot's name that a goal follows."""
LEADS_ON: frozenset[str] = frozenset(("to", "at", "here", "into", "in"))
"""What opens that goal."""
SENDING: frozenset[str] = frozenset((
    "recall", "redirect", "reroute", "divert", "transfer", "shift", "steer", "manoeuvre", "maneuver", "shuttle", "pull",
    "run", "walk", "roll", "trundle", "scoot", "zip", "nip", "jog", "march", "swing", "hop", "whizz",
    "withdraw", "summon", "call", "assign", "pilot", "usher",
))  # fmt: skip
"""The same, where the goal opens with `to` or `here`: `recall the rover at base` may be no order at all."""

BEFORE_AN_OBJECT: tuple[tuple[str, str], ...] = (
    ("(take|takes) up", "pick up"),
    ("(item|cargo|package|parcel|consignment|freight)", "the"),
    ("(is|are) (waiting for|waiting on|expecting|out of)", "needs"),
    ("(has been|have been) (asking for|waiting for|calling for)", "needs"),
    ("(might|may|can|could) (i|we) (have|get|please have|please get|just have|just get|possibly have)", "could i have"),
    ("(retrieve|collect|obtain|procure|go and get|go and fetch|go and collect|run and get|go grab)", "fetch"),
    (
        "(cart|shuttle|ferry|courier|lug|tote|schlep|ship|relay|rush|whisk|hustle|speed|forward|wheel|trot|walk|run)",
        "carry",
    ),
    ("(rest|stick|plonk|plop|deposit)", "put"),
    ("(clutch|grip|clasp)", "hold"),
    ("i wonder if (i|we) (might|may|can|could) (have|get)", "could i have"),
    ("(i'm|i am|we're|we are) (dying|gasping|longing|desperate|itching|aching|yearning|waiting) for", "i want"),
    (
        "(i|we) (|really |do |just )(could murder|could kill for|would kill for|fancy|could do with|could use|"
        "would die for|crave|wish for|wish i had|wouldn't mind|long for|could have)",
        "i want",
    ),
    ("(i'd|we'd) (|really |just )(kill for|fancy|die for|give anything for|murder|settle for|welcome)", "i want"),
    ("(|oh )how (i'd|i would|we'd) (love|like)", "i want"),
    ("(can|could|may) (i|we) get (my|our) hands on", "could i have"),
    ("(let me have|let us have|i'll have|i'll take|i will have|i will take|we'll have|we'll take)", "could i have"),
)
"""The same, only in front of an object's name."""

BEFORE_A_ZONE: tuple[tuple[str, str], ...] = (
    ("(he|she) (is|was) (|out |over |lost |somewhere |last seen )(in|on|at)", "in"),
    ("(he's|she's) (|out |over |lost |somewhere )(in|on|at)", "in"),
    ("somewhere (on|within|around|about|across)", "in"),
    ("(over|down|up|out|away) (in|at|on)", "in"),
    ("fly (the|our)", "search the"),
    ("(anywhere|all about|all around|any place) (on|in|within|over|across)", "in"),
    ("(|i need |we need |i want |we want |get |put |give me |keep )eyes (on|over|above)", "search"),
    (
        "(|have a look at |take a look at |look at |see |check |find out )(what's|what is|who's|who is) (in|over)",
        "search",
    ),
    ("(hunt|forage|scrounge|poke) (around|about|through|over|round)( in|)", "search"),
    (
        "(probe|examine|trawl|recce|look through|hunt through|search through|sweep over|quarter|rake|scrutinise|"
        "scrutinize)",
        "search",
    ),
)
"""The same, only in front of a zone's name."""

RAISING: frozenset[str] = frozenset(("get", "take", "put", "bring", "send", "fly", "lift", "raise"))
UP_IN: tuple[Words, ...] = tuple(
    tuple(said.split())
    for said in (
        "up in the air", "up into the air", "in the air", "into the air", "up in the sky", "in the sky", "into the sky",
        "off the ground", "airborne", "aloft", "flying", "up there", "up",
    )
)  # fmt: skip
"""Verbs and what stands behind a robot's name, for its taking off; the longest first."""
LOWERING: frozenset[str] = frozenset(("put", "set", "get", "bring", "place"))
DOWN_ON: tuple[Words, ...] = tuple(
    tuple(said.split())
    for said in (
        "back down on the ground", "back on the ground", "down on the ground", "on the ground", "onto the ground",
        "back down", "down",
    )
)  # fmt: skip
"""The same for its landing."""
TASKING: frozenset[str] = frozenset(("task", "charge", "entrust", "trust"))
"""Verbs for giving a robot something to do: `task the drone with a search`."""
ASSIGNING: frozenset[str] = frozenset((
    "assign", "detail", "commit", "allocate", "appoint", "deploy", "employ", "task", "set", "require", "request",
))  # fmt: skip
"""The same: `assign the drone to search`."""
WISHING: frozenset[str] = frozenset(("have", "get", "want", "need"))
"""Verbs for having something done: `have it delivered`."""

HESITATIONS: frozenset[str] = frozenset(("um", "uh", "uhm", "er", "erm", "hmm", "hm", "mm", "ah", "umm", "uhh", "ehm"))
"""Sounds that say nothing, except between two figures or two names of one kind, where they may correct."""

ARROWS: tuple[str, ...] = ("->", "=>", "-->", "==>", ">", ">>")
"""Marks that mean `to`."""

WAITING: tuple[Words, ...] = tuple(
    tuple(said.split())
    for said in (
        "wait for me at",
        "wait for me in",
        "wait over at",
        "wait at",
        "wait in",
        "wait by",
        "hold at",
        "hold in",
        "hold position at",
        "hold position in",
        "stand by at",
        "stand by in",
        "take up position at",
        "report to",
        "take up position in",
        "take position at",
        "take position in",
        "take station at",
        "take station in",
        "take up station at",
        "take your place at",
        "take your place in",
        "station yourself at",
        "station yourself in",
        "position yourself at",
        "position yourself in",
        "park yourself at",
        "park yourself in",
        "park at",
        "park in",
        "stage at",
        "report at",
        "get ready at",
        "be ready at",
        "sit in",
        "lie down in",
        "stand at",
        "stand in",
        "stay at",
        "stay in",
        "line up at",
        "set up at",
    )
)
"""Before a place: to go there."""


@cache
def wordings() -> Wordings:
    """Every wording with its plain words."""
    return of_templates(REWRITES)


@cache
def wordings_before_objects() -> Wordings:
    """The same, for wordings in front of an object's name."""
    return of_templates(BEFORE_AN_OBJECT)


@cache
def wordings_before_places() -> Wordings:
    """The same, for wordings in front of a place's name."""
    return of_templates(BEFORE_A_PLACE)


@cache
def wordings_before_zones() -> Wordings:
    """The same, for wordings in front of a zone's name."""
    return of_templates(BEFORE_A_ZONE)


@cache
def wordings_before_goals() -> Wordings:
    """The same, for wordings in front of a place's name or a point."""
    return of_templates(BEFORE_A_GOAL)


@cache
def wordings_before_robots() -> Wordings:
    """The same, for wordings in front of a robot's name."""
    return of_templates(BEFORE_A_ROBOT)


@cache
def wording_words() -> frozenset[str]:
    """Every word of a wording: none of them is a slip."""
    before = (wordings_before_goals(), wordings_before_places(), wordings_before_robots(), wordings_before_zones())
    tables = (wordings(), wordings_before_objects(), *before)
    said = (word for table in tables for word in table.words)
    done = (w for verbs in DONE_AT.values() for said in verbs for w in said.split())
    return frozenset(
        (
            *said,
            *done,
            *HESITATIONS,
            *TASKING,
            *ASSIGNING,
            *(w for words in (*WAITING, *UP_IN, *DOWN_ON) for w in words),
        )
    )
