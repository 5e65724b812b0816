"""Wordings with names in them, and the plainer words for each. Templates, no logic; `patterns.py` says how they read.

No plainer wording adds a name, a place, a figure or a negation, nor takes one away.
"""

import re

from crew.contracts.language.plainer_moves import MOVES
from crew.contracts.language.plainer_walks import WALKS

_MAY = "(may|might|can|could)"
_WISH = (
    "(what i want is|what i need is|all i want is|all i need is|what we need is|what i'd like is|all we need is|"
    "what i would like is|what we want is|what i need is ,|what i want is ,|"
    "i want|i need|i require|i'd like|i would like|i should like|i'd love|i would love|i'd prefer|i would prefer|"
    "i wish|i'd appreciate|i'll have|i would like to receive|i'd like to receive|i want to receive|i'd like to get|"
    "i would like to get|i want to get|we want|we need|we require|we'd like|we would like|we should like|we'd love|"
    "we would love|we'd prefer|we wish)"
)
_HAVE = "(have|get|see|want|let|need)"
_HAND = "(hand|hands|palm|palms|fingers)"
_MY_HAND = f"(in|into|to|on|onto) (my|our) (|own |open |outstretched |free |waiting |empty |two |very own ){_HAND}"
_GIVING = (
    "(put|place|set|lay|drop|hand|give|pass|bring|press|slip|pop|stick|deposit|deliver|get|take|fetch|put down|"
    "move|return)"
)
_SIT = "(armchair|chair|seat|sofa|couch|bed|wheelchair|desk|recliner|bench|bedside|workstation|workplace|place|spot)"
_AM = (
    "(i'm|i am|i sit|i'm sitting|i am sitting|i'm standing|i am standing|i stand|i'm lying|i am lying|i lie|"
    "i'm waiting|i am waiting|i work|i'm working|i am working|i'm seated|i am seated|i stay|i'm staying|i live|"
    "we are|we're|we sit|we're sitting|we are sitting|we stand|we're standing|we are standing|we're waiting|"
    "we are waiting|i happen to be|i am now|i'm at|i am at)"
)
_STAYS = (
    "(has moved|has gone|is|is now|is sitting|is waiting|sits|waits|has gone over|has moved over|is over|is down|is up|"
    "is currently|has settled|works|is working|has moved on|stays|is staying)"
)
_LACKS = (
    "(needs|requires|wants|is out of|has run out of|is short of|is asking for|is thirsty for|could do with|could use|"
    "has no|is in need of|is running out of|has asked for|would like|is low on|is running low on|has requested|need)"
)
_DRINK = "(water|drinking water|something to drink|drinks|a drink|refreshment|refreshments|hydration)"
_TIRED = "(tired|exhausted|worn out|sleepy|weary|knackered|tired out|shattered|done in|pooped)"
_CHARGED = (
    "(on charge|on to charge|onto charge|charging|recharging|charged|charged up|recharged|plugged in|topped up|"
    "to charge|to recharge|on the charge|charging up)"
)

_GRAB = "(grab|pick up|take|get|fetch|lift|grasp|collect|pick|lift up|take hold of|get hold of|seize)"

_AND = "(|there |over there |, )(and|and then|and ,) (|please |like |like , |then |just |also )"

PLAINER: tuple[tuple[str, str], ...] = (
    (f"{_GIVING} {{object}} (|down |back |over |right |straight ){_MY_HAND}", "hand {object} to me"),
    (f"{_GIVING} {{it}} (|down |back |over |right |straight ){_MY_HAND}", "hand {it} to me"),
    (f"(hand|give|pass|bring|get|fetch) (me|to me|for me) {{object}} {_MY_HAND}", "hand me {object}"),
    (f"(hand|give|pass|bring) (|to )me (in|into) (the|my) {_HAND} {{object}}", "hand me {object}"),
    (f"{_WISH} {{object}} (in|into) the {_HAND}", "hand {object} to me"),
    (f"{_WISH} (|to have ){{object}} (|put |placed |given |laid |set ){_MY_HAND}", "hand {object} to me"),
    (f"^ {_MAY} (i|we) (have|get) {{object}} {_MY_HAND}", "hand {object} to me"),
    *((f"^^ {{object}}{mark} (|here |here , |right ){_MY_HAND}", "hand {object} to me") for mark in ("", " ,", " .")),
    (f"^ {_DRINK} for {{place}} $", "{place}"),
    (f"^ (need|want|would like|require) {{object}} {_MY_HAND}", "hand {object} to me"),
    (
        f"(hand|give|pass|bring|put|lay|place) (|to )me (|please )(in|into|to|on) (the|my) {_HAND} "
        "(|please ){object}",
        "hand me {object}",
    ),
    (f"(hand|give|pass|bring|put|lay) (|to )me {{object}} (in|into|to|on) (the|my) {_HAND}", "hand me {object}"),
    ("(up|down|over|right) (on|onto|on to) {robot}", "onto {robot}"),
    (
        "and (taken|brought|carried|delivered|moved|transported|hauled|conveyed) (|over |up |back )(to|into)",
        "and take it to",
    ),
    ("and (put|placed|set|set down|laid) (|back |down )(on|onto)", "and put it on"),
    *(
        (f"^ {{robot}} , (he|she|it|they) {must}", f"{{robot}} {must}")
        for must in ("must", "should", "shall", "has to", "needs to", "is to", "have to")
    ),
    ("^ {robot} , (can|could|would|will|may) (it|he|she|they)", "{robot} please"),
    ("{robot} (thing|thingy|creature|contraption|machine)", "{robot}"),
    *(
        (
            f"(get|collect|fetch|pick up|take|receive|accept) {{object}} from {{giver}} and {verb} (it|them)",
            f"{verb} {{object}}",
        )
        for verb in ("deliver", "take", "bring", "carry", "transport", "haul")
    ),
    *(
        (f"{_GRAB} {{object}} {_AND} {verb} {given}", f"{verb} {{object}} to me")
        for verb in ("give", "hand", "pass", "bring")
        for given in ("(it to me|it over to me|me it|it me)", "(it over|it here|it over here) $")
    ),
    (f"(to|at|over to|up to|round to) (|the place |the spot |the place |the chair )(where|wherever) {_AM}", "to me"),
    (f"(to|over to) the {_SIT} (|that |where |which )(i'm|i am) (sitting|lying|standing|working) (|in|on|at)", "to me"),
    (f"(to|over to|by|beside) me (|here |over here )(on|in|at|by) (the|my|this) (|big |old ){_SIT}", "to me"),
    (f"^ {_HAVE} {{object}} (|to be |be |being ){{done}}", "{done} {object}"),
    (f"^ {_HAVE} {{it}} (|to be |be |being ){{done}}", "{done} {it}"),
    (f"{_WISH} (|to have |to get |to see |having ){{object}} (|to be |be |being ){{done}}", "{done} {object}"),
    (f"^ {_MAY} (i|we) (|please )(have|get|ask for|ask to have) {{object}} (|to be ){{done}}", "{done} {object}"),
    ("(be|being|get) (put|set|put down|set down)", "be placed"),
    ("{object} (needs|wants|requires|could do with) {doing}", "{object} please {doing}"),
    (
        "(|go and )(see about|see to|arrange|organise|organize|look after|take care of|get on with) {doing}",
        "{doing}",
    ),
    ("it must be {done} {object}", "{done} {object}"),
    (
        "(make sure|see|see that|see to it that|make sure that|ensure|ensure that|make certain|be sure) {object} "
        "(ends up|winds up|lands|sits) (on|onto)",
        "make sure that {object} is on",
    ),
    (
        "(make sure|see|see that|see to it that|make sure that|ensure|ensure that|make certain|be sure) {object} "
        "(ends up|winds up|lands) (in|at)",
        "make sure that {object} is in",
    ),
    (
        "^ (see|ensure|make certain|take care that|mind that) {object} (gets|goes|comes|arrives) (to|in|at)",
        "make sure that {object} gets to",
    ),
    ("^ (make it so|make it so that|fix it so|fix it so that|do that|do so that|make so that)", "make sure that"),
    ("^ (have|get|put) {robot} (back |)(on|onto|in|at|by) (its|his|her|their) {place}", "send {robot} to {place}"),
    (f"^ (|let's |lets |let us )(have|get|put|set|leave) {{robot}} {_CHARGED} $", "send {robot} to charging"),
    (
        "^ (let|have|get|make) {robot} (recharge|charge|charge up|recharge itself|charge itself) $",
        "send {robot} to charging",
    ),
    ("(is|is it|it is|would it be|might it be|will it be) possible (for|) {robot} to", "please {robot} to"),
    ("^ (have|let|get|make|tell) {robot} (|to )do (it|that|this|so) $", "with {robot}"),
    ("^ (carried|transported|taken|delivered|brought|moved|hauled|conveyed) (by|on|with) {robot}", "by {robot}"),
    ("^ is possible (that|for|) {robot}", "please {robot}"),
    ("(i'd|i would|we'd|we would|i'll|we'll) (have|let|get) {robot}", "have {robot}"),
    (
        "(proceed|go|move|head|walk|travel|return|march|trot|come) to drop off (point|spot|place|zone|area|location)",
        "go to the drop off",
    ),
    ("(proceed|go|move|head|walk|travel|return|march|trot|come) to drop off $", "go to the drop off"),
    (
        "^ {owner} (battery|batteries|charge|power) (is|are|is getting|is running|looks|is nearly|is almost|seems) "
        "(low|flat|empty|down|dead|a bit low|very low) (, so|so|,|.|;) (|please )(send|take|get|bring|walk|move) it to "
        "(the|its) (charger|charging station|charging dock|dock|charging point)",
        "send {owner} to the charging",
    ),
    ("{robot} of (yours|ours|mine|theirs|his|hers)", "{robot}"),
    ("(on|onto|on to|upon) {owner} back", "on {owner}"),
    ("^ (let's|lets|let us) (have|make) {robot}", "have {robot}"),
    ("^ (let's|lets|let us) have {object} (|then |here |over here )$", "could i have {object}"),
    (
        f"{{place}} {_LACKS} (|some |more |a bit of |any |a bottle of |fresh |some fresh |some more ){_DRINK} $",
        "{place}",
    ),
    (f"{{place}} {_LACKS} (|some |more |a bit of |any |fresh |some fresh |some more ){_DRINK} (so|and)", "{place} ,"),
    ("(and|then|and then) (off|away|on|out) (to|into|over to) {place} with {it}", "and take {it} to {place}"),
    (
        f"{{robot}} (looks|seems|must be|is looking|appears) (|so |very |a bit |rather |quite |really ){_TIRED} $",
        "{robot}",
    ),
    (
        "{object} to (play with|drink|drink from|look at|use|have a look at|have fun with|take a look at|sip|"
        "drink out of|quench my thirst|wet my whistle) $",
        "{object}",
    ),
    ("^^ (|yeah |well |so |okay |ok |yes |look |oh |right )i mean (|just |like )", "please"),
    (f"{{operator}} {_STAYS} (to|in|at|into|by) {{place}} and (needs|wants|requires)", "{operator} needs"),
    (f"{{operator}} {_STAYS} (to|in|at|into|by) {{place}} $", "{operator}"),
    (
        "{operator} (is|sits|stands|is standing|is sitting|is waiting|waits) (|right |just )(at|by|beside|"
        "next to|near) "
        "(the|his|her|their) (table|desk|robot|humanoid|chair) and (needs|wants|requires)",
        "{operator} needs",
    ),
    ("^^ {object} (for me|for us) $$", "bring me {object}"),
    ("^^ {object} (for me|for us) (|,) please $$", "bring me {object}"),
)
"""What is said, and what it is read as; the first that fits."""


def plainer_words() -> frozenset[str]:
    """Every word of these wordings: none of them is a slip."""
    return frozenset(
        w for said, _ in (*PLAINER, *MOVES, *WALKS) for w in re.findall(r"[a-z']+", re.sub(r"\{\w+\}", "", said))
    )
