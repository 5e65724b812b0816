"""What people say of themselves who want something brought: `I'm sitting next to the humanoid`, `I need it for my tea`.

Where that person is, sensors tell; what is said of it is no part of a request that brings something to them. Of any
other request it may be a warning, and stays. Patterns of whole clauses, no logic; `@robot` and `@place` stand for names
of the crew.
"""

_NOUN = r"(?!(?:way|path|line|danger|risk|limit|order|trouble|moment|time|end)\b)[a-z']+"
_DETERMINER = "(?:all these|all those|all this|these|those|the|my|our|a|an|this|that|your|his|her|their)"
_THING = f"{_DETERMINER} (?:{_NOUN} ){{0,2}}{_NOUN}"
_SIDE = (
    "(?:the )?(?:very )?(?:far |other |opposite |near |left |right |back |front |far-off )?"
    "(?:end|side|corner|edge|part|back|front|bottom|top|half)"
)
_ROOMS = (
    "kitchen|bathroom|bedroom|living room|dining room|sitting room|lounge|hall|hallway|corridor|garden|office|study|"
    "workshop|garage|lab|laboratory|library|lobby|canteen|cafeteria|house|flat|building|ward|tent|yard|classroom|"
    "conservatory|studio|basement|attic|cellar|store|stockroom|reception|meeting room|conference room|break room|room|"
    "next room|room next door|corner|chair|armchair|wheelchair|sofa|couch|bed|recliner|rocking chair|bench|stool|seat|"
    "cubicle|booth|lobby|foyer|waiting room|staff room|common room|playroom|nursery|laundry|toilet|shower|bath"
)
_IN = (
    f"(?:in|inside|on|into) (?:{_DETERMINER} )?(?:other |next |big |little |old |back |front |own )?(?:{_ROOMS}|@place)"
)
_BY = (
    "(?:right |just |directly |immediately |close |very |quite |so ){0,3}"
    "(?:next to|next|beside|by|near|nearby|near to|near of|close to|close by|close|alongside|at|opposite|across from|"
    "away from|far from|far away from|a long way from|on the other side of)"
)
_LOOSE = (
    "right|just|directly|kinda|kind of|sort of|sorta|still|already|now|currently|over|back|up|down|out|all|away|far|"
    "far away|close|close by|"
    "near|nearby|"
    "alone|and|comfortably|quite|very|only|way|through|waiting|sitting|standing|seated|lying|resting|working|stuck|"
    "stood|sat|"
    "sitting down|standing up|lying down|reading|too far|too far away|a bit|a little|rather|so|really|thirsty|parched|"
    "beside|alongside|tied up|caught up|held up|engaged|occupied|(?:tied up|busy|stuck|caught up|engaged) with "
    f"{_THING}|hungry|tired|cold|stuck|busy|exhausted|comfortable|cosy|not well|unwell|ill|poorly"
)
_HERE = (
    "here|over here|right here|there|over there|upstairs|downstairs|next door|elsewhere|outside|in bed|at home|"
    "at work|indoors|right next door|in reach|within reach|in arm's reach|within arm's reach|not far|a few steps away|"
    "beside|just beside|alongside|nearby|close by|at the back|in the back|at the front|sitting|standing|seated|waiting|"
    "lying down|sitting down|ready|"
    "ready to take it|ready for it|in position|in place"
)
_AT = (
    f"(?:{_BY} (?:you(?: @robot)?|(?:(?:the|a|your|that|this|our) (?:[a-z]+ )?)?@robot|(?:the |a )?@place|{_THING}|"
    "(?:his|its) side)"
    f"|to me|at your (?:side|elbow|position|feet|place)|with {_THING}"
    f"|{_IN}|(?:at|on|in|by) {_SIDE}(?: of (?:the |a |this |that )?(?:@robot|@place|{_NOUN}(?: {_NOUN})?))?"
    "|(?:down|up|along) (?:the |a )?(?:hall|corridor|hallway|passage|stairs|landing)"
    f"|across (?:from )?{_THING}(?: from (?:you|(?:the )?@robot|(?:the )?@place|{_THING}))?"
    f"|at (?:the |a )?(?:@place|home|work|school|hospital))"
)
_AM = (
    "(?:(?:i|we) (?:am|are|was|sit|stand|lie|wait|stay|stand here|remain|work)|i'm|we're|(?:i|we) (?:have|'ve) moved|"
    "(?:i|we)'ve moved|(?:the )?@me (?:is|sits|stands|waits|has moved))"
)
_TAIL = (
    "(?: (?:here|over here|right here|over there|there|only|now|today|at the moment|right now|already|waiting|"
    "and waiting|ready|for it|for now|though|you see|"
    "too)){0,3}"
)
_HAND = "(?:hand|hands|palm|palms|arm|arms)"
_HELD = (
    f"with (?:my|a|one|both) (?:free |open |right |left )?{_HAND}"
    "(?: (?:out|open|ready|up|free|held out|stretched out|outstretched)){0,3}"
)

_CANNOT = (
    "(?:i|we)(?: really| just| simply| quite| still)* (?:can't|cannot|can not|can hardly|can barely|couldn't|could not|"
    "am unable to|are unable to|am not able to|don't manage to|struggle to)|(?:i'm|we're) (?:unable to|not able to)|"
    "can't|cannot"
)
_COME = (
    "get up|stand up|stand|get out|get over|get across|get there|get to you|come over|come to you|come|come and get it|"
    "get it myself|get it|reach|reach it|reach that far|walk|walk over|walk that far|walk far|make it|make it over|"
    "make it across|make it there|move|move about|move around|get down|bend down|leave|"
    f"leave here|leave {_THING}|go|go over|go there|go far|get away|step away|do stairs|do the stairs|"
    "get about"
)

_USE = (
    "play|play a game|show|drink|drink from|use|have a look at|look at|take a look at|check|measure|photograph|film|"
    "draw|paint|wash|clean|examine|study|test|try|see|read|build|build something|build a tower|make|cook|bake|eat|"
    "have|take my pills|take my medicine|take my tablets|take a pill|take a sip|take a drink|have a drink|have a sip|"
    "wash down|try out|work|start|finish|fill|refill|open|keep|inspect|practise|practice|experiment|calibrate|weigh|"
    "demonstrate|stack"
)
_NOT_A_TIME = (
    "(?!(?:minute|minutes|moment|hour|hours|day|days|night|week|month|year|morning|evening|afternoon|time|while|now|"
    "second|seconds|rest|duration|weekend|being|sake|case|safety|risk)\\b)"
)
_USED = f"(?:{_DETERMINER} )?(?:{_NOT_A_TIME}{_NOUN} ){{0,2}}{_NOT_A_TIME}{_NOUN}"

OF_THEMSELVES: tuple[str, ...] = (
    "(?:i|we|i'd|we'd)(?: just| really| only| do)? (?:need|want|like|would like|am going to|are going to|have|love|"
    f"would love|got)(?: it| that| this| one)?(?: to (?:{_USE})(?: (?:it|that|this|with it|with that|some))?"
    f"(?:(?: (?:to|with|for|on|in|at))? {_USED})?| for {_USED})(?: (?:now|soon|please|too|today|again)){{0,2}}",
    f"(?:it's|it is|that's|that is) for {_USED}",
    "(?:to|so i can|so that i can|so we can|so that we can) (?:play|drink|show|work|experiment|practise|practice)"
    f"(?: (?:it|with it|some|with {_USED}|to {_USED}))?",
    "(?:i'm|i am|we're|we are) (?:going|about) to (?:drink|use|play with|measure|test|show|paint|photograph|film) "
    f"(?:it|that|this|some)(?: for {_USED})?",
    f"(?:{_CANNOT})(?: easily| quite| really| just| so well| very well)* (?:{_COME})"
    "(?: (?:so well|very well|well|easily|myself|right now|at the moment|any more|anymore|just now|now|today|"
    "quickly)){0,2}"
    f"(?: (?:from|out of|off|with|on|in|because of) {_THING}| {_AT}){{0,2}}{_TAIL}",
    f"{_AM}(?: (?:{_LOOSE})){{0,5}}(?: (?:{_HERE}))?(?: {_AT}){{1,2}}{_TAIL}(?: {_HELD})?",
    f"{_AM}(?: (?:{_LOOSE})){{0,5}}(?: (?:{_HERE})){_TAIL}(?: {_HELD})?",
    f"(?:i've|i have|i have got|i've got|i got|i hold|i'm holding|i am holding|i'll hold|holding|with) (?:out )?"
    f"(?:my|a|an|one) (?:free |open |other |right |left )?{_HAND}"
    f"(?: (?:out|open|ready|free|up|held out|stretched out|outstretched|here)){{0,3}}(?: {_AT})?{_TAIL}",
    f"(?:my|our) (?:free |right |left |other )?{_HAND} (?:is|are) (?:right |already |here |wide |held ){{0,3}}"
    f"(?:out|open|ready|here|waiting|free|empty|held out|stretched out|outstretched|there)(?: {_AT})?{_TAIL}",
    "(?:you|you'll|you will|you can) (?:find|see|spot) me (?:right |over )?(?:here|there)?(?: ?" + _AT + ")?",
)
"""Clauses that say what a thing is wanted for, where the person is, that a hand is out, or that they cannot come."""
