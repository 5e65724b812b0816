"""What people say of themselves and around a request, which is no part of it: patterns of whole clauses, no logic.

A clause of this kind has its own subject, and names nothing of the crew. Nothing in it may be a place, a time, a
quantity, a permission, a warning or a condition: whoever adds a word here asks first what it would be as a constraint.
"""

import re

from crew.contracts.language.courtesies import COURTEOUS_CLASSES
from crew.contracts.language.persons import CIVIL, COMPOUNDS, FAMILY, HELPERS, NO_SLIPS, REPORTED, YEARS_OLD

CLASSES: dict[str, str] = {
    "i": "i|we",
    "am": "i'm|i am|we're|we are|i feel|we feel|i was|i'm feeling|i am feeling",
    "have": "we've still got|we still have|i've still got|i still have|i have|i've|i've got|i have got|i got|"
    "we have|we've got",
    "my": "my|our",
    "very": "so|very|really|quite|a bit|a little|rather|too|pretty|terribly|awfully|just|a little bit|kinda|"
    "kind of|sort of|sorta|ever so|getting|absolutely|completely|utterly",
    "feeling": "tired|thirsty|hungry|starving|cold|freezing|busy|worried|worried sick|anxious|scared|afraid|nervous|"
    "excited|bored|sick|ill|unwell|poorly|exhausted|dizzy|upset|sad|curious|confused|old|old now|an old man|"
    "an old woman|"
    "an old lady|new here|new to this|in a hurry|in a rush|running late|getting old|getting on|getting tired|not well|"
    "parched|famished|peckish|knackered|shattered|worn out|drained|frantic|panicking|stressed|terrified|shaken|"
    "heartbroken|distraught|embarrassed|lonely|weary|drowsy|sleepy|dehydrated|dying of thirst|gasping|freezing cold|"
    "starving hungry|worried to death|out of my mind with worry|"
    "not feeling well|not so young any more|not as young as i was|not young any more|out of breath|blind|deaf|shaking|"
    "glad|happy|desperate|in pain|in a bit of a hurry|no expert|not sure how this works|beside myself",
    "body": "hand|hands|leg|legs|knee|knees|arm|arms|foot|feet|back|eye|eyes|eyesight|sight|hearing|ears|hip|hips|neck|"
    "shoulder|shoulders|wrist|wrists|finger|fingers|ankle|memory|throat|mouth|head|heart|nerves",
    "ails": "hurts|hurt|aches|ache|is hurting|are hurting|is aching|are aching|shakes|shake|is shaking|are shaking|"
    "is sore|"
    "are sore|is bad|are bad|is stiff|are stiff|is weak|are weak|is tired|are tired|is broken|is killing me|"
    "are killing me|is dry|is gone|are gone|fails me|fail me|is failing|are failing|is not good|are not good|"
    "isn't good|"
    "aren't good|isn't great|aren't great|don't work|doesn't work|is going|are going|won't carry me|is playing up|"
    "is not what it was|are not what they were|isn't what it was|aren't what they were|isn't what it used to be|"
    "aren't what they used to be|trembles|tremble|is trembling|are trembling|is cold|are cold|is racing|is pounding",
    "ailing": "bad|greasy|wet|dirty|sticky|oily|muddy|soapy|filthy|slippery|burnt|bandaged|frozen|sore|stiff|weak|"
    "broken|sprained|dodgy|poor|terrible|shaky|numb|swollen|useless|slow|wobbly|unsteady|"
    "tired|dry|cold|killing me|failing",
    "cannot": "can't|cannot|can not|can hardly|can barely|don't|do not|couldn't|could not",
    "manage": "see|hear|walk|walk far|move|stand|stand up|get up|bend|bend down|sleep|manage|manage alone|do it myself|"
    "do it alone|do this myself|do this alone|see much|see anything|hear much|see a thing|hear a thing|get about|"
    "get around|cope|remember|remember how this works|run|climb",
    "well": "well|very well|so well|that well|too well|properly|much|very much|any more|anymore|these days|today|"
    "at all|right now|at the moment|very well any more|very well these days|so well any more|so well these days|"
    "very well anymore|far|by myself|on my own|as i used to|like i used to|alone|very far|now",
    "it": "it is|it's|this is|that is|that's",
    "late": "late|scary|dark|cold|hot|urgent|important|very important|an emergency|serious|"
    "a matter of life and death|nice|"
    "getting late|getting dark|getting cold|late already|hot today|cold today|hot in here|cold in here|"
    "getting late already|the end of the day|lunchtime|terrible|awful|dreadful|a worry|my first time|a lovely day|fun|"
    "a beautiful day|the least we can do|so exciting|the right thing",
    "person": "|".join((
        "<people>|victim|casualty|survivor|patient|missing person|injured person|hiker|person|someone|somebody|party",
        *CIVIL, *HELPERS, *(f"{said} {noun}" for noun, many in COMPOUNDS.items() for said in many),
    )),
    "persons": "|".join((
        "people|persons|children|kids|men|women|hikers|patients|friends|gentlemen|ladies|team|party|group|staff|"
        "family|crew",
        *(f"{noun}s" for noun in (*FAMILY, *CIVIL, *HELPERS)),
    )),
    "people": "|".join((*FAMILY, "kids", "children", "pal", "mate", "buddy", "patient", "friends")),
    "whose": "my|our|the|a|an|some|his|her|their|this|that|one|another",
    "poor": "poor|little|old|dear|young|elderly|lost|missing|dearest|own|best|beloved|dear old|late night|teenage|male|"
    "female|frail|confused|injured|lone|solo|small|big|elder|younger|eldest|youngest|" + f"(?:{YEARS_OLD})",
    "gone": "(?:has )?never (?:came|come|got|made it) (?:back|down|home|in|out|up)|went out|has gone out|"
    "went for a walk|"
    "(?:has )?never (?:crossed|reached|passed|made it to|got to) the (?:finish line|finish|line|checkpoint|"
    "last checkpoint|"
    "top|bottom|lodge|hut|camp)|(?:has )?never (?:clocked out|clocked off|signed out|checked in|checked out|showed up|"
    "shown up|reported in|reported back|reported|arrived|finished|answered)|is lost|is missing|are lost|are missing|"
    "got lost|has got lost|has gotten lost|has gone missing|"
    "went missing|"
    "is gone|has gone|has disappeared|disappeared|has vanished|vanished|has wandered off|wandered off|ran off|ran away|"
    "has run off|has run away|has not come back|hasn't come back|did not come back|didn't come back|never came back|"
    "did not come home|didn't come home|hasn't come home|has not come home|has been missing|was reported missing|"
    "is reported missing|has been reported missing|reported missing|reported overdue|is overdue|overdue|gone missing|"
    "is unaccounted for|unaccounted for|has not been seen|hasn't been seen|not been seen|has not returned|"
    "hasn't returned|failed to return|has failed to return|did not return|didn't return|never returned|"
    "is still missing|still missing|is still out|is still out there|is nowhere to be found|is nowhere to be seen|"
    "has been lost|has been gone|has been overdue|has not turned up|hasn't turned up|did not turn up|didn't turn up|"
    "never turned up|has failed to turn up|has not shown up|hasn't shown up|has got herself lost|"
    "has got himself lost|got himself lost|got herself lost|has strayed|has not reported in|hasn't reported in|"
    "has not checked in|hasn't checked in|did not check in|didn't check in|walked out|has walked out|slipped away|"
    "has slipped away|has wandered away|wandered away|has wandered out|wandered out|went out walking|"
    "went out for a walk|went for a walk|is out there somewhere|did not report in|didn't report in|failed to report in|"
    "has failed to report in|missed his check in|missed her check in|missed a check in|has missed his check in|"
    "has missed her check in|is not answering|isn't answering|does not answer|doesn't answer|is out of contact|"
    "has lost contact|lost contact|is not responding|isn't responding|is not picking up|isn't picking up|"
    "did not report|didn't report|did not report back|didn't report back|has not reported back|"
    "hasn't reported back|did not arrive|didn't arrive|never arrived|got separated|has got separated|fell behind|"
    "has been injured|got hurt|is hurt|is injured|has had a fall|had a fall|has fallen|fell|is in trouble|needs help|"
    "is in need of help|"
    "lost|missing|walked off|has walked off|lost his way|lost her way|has lost his way|has lost her way|strayed",
    "astray": "lost|missing|overdue|gone|gone missing|disappeared|vanished|wandered off|been missing|been gone|"
    "not back|not back yet|not come back|not returned|still out there|still missing|hurt|injured|unaccounted for|"
    "got lost|run off|walked off|strayed|in trouble|out of contact|not answering(?: <phone>)?|not picking up(?: "
    "<phone>)?|"
    "not responding(?: <phone>)?|not reachable|unreachable|not been seen|not been heard from|not checked in|"
    "not reported in|needing help|fallen|had a fall|not himself|not herself|not well|unwell",
    "phone": "(?:his|her|their|the) (?:phone|radio|mobile|calls|cell|telephone|handset|messages|texts)",
    "age": "[0-9]{1,3}|[0-9]{1,3} years old|" + YEARS_OLD + "|a child|a pensioner|an elderly man|an elderly woman|"
    "an old man|an old lady|elderly|old|frail|confused|diabetic|my (?:<people>)|our (?:<people>)",
    "since": "out there|there|over there|somewhere|somewhere out there|this morning|last night|yesterday|"
    "since this morning|since last night|since yesterday|again|today|for hours|for hours now|in the woods|on a walk|"
    "on a hike|and has not come back|and hasn't come back|and never came back|and did not come back|"
    "and didn't come back|and has not returned|and hasn't returned|and is not back|and isn't back|and is missing|"
    "earlier|earlier today|this afternoon|this evening|tonight|overnight|in the night|during the night|"
    "since (?:roll call|the morning roll|school|work|the start|supper|tea time|six|seven|eight|nine|ten|eleven|twelve)|"
    "after (?:breakfast|lunch|dinner|school|work|dark|the race|the party|class)|"
    "from (?:his|her|their|a|the|our) (?:[a-z]+ ){0,2}[a-z]+|separated from (?:his|her|their|the) (?:[a-z]+ )?[a-z]+|"
    "a while ago|since dawn|since breakfast|since lunch|since the (?:lunch|breakfast|dinner|morning|noon)|"
    "since noon|since midday|since dinner|since nightfall|"
    "since sunrise|since dusk|since yesterday evening|since this afternoon|since the morning|"
    "from (?:his|her|their|a|the|its) (?:walk|hike|run|ride|swim|shift|trip|round|rounds|patrol|stroll|ramble|group|"
    "party|family|friends|class|tour|excursion|outing|hike today)|"
    "from (?:his|her|their|a|the) (?:bench|garden|path|trail|track|tent|car|bus|campsite|hotel|playground|picnic|"
    "ward|room|car park|house|bed|porch|stand|queue|line|troop|patrol|unit|platoon|squad|school|barbecue|fair)|"
    "on (?:his|her|their|a|the) (?:walk|hike|run|ride|shift|round|rounds|stroll|trail|path|way back)|"
    "by (?:his|her|their|the) (?:wife|husband|family|friends|mother|father|parents|colleagues|neighbours|carer)|"
    "(?:[0-9]+|an|one|two|three|four|five|six|a few|several) (?:hour|hours|days|day|minutes) ago|(?:for|since) (?:a|"
    "an|one|two|three|four|five|six|many|several|some|[0-9]+) (?:hour|hours|day|days|"
    "minutes)(?: now| already)?",
    "lost": "lost|have lost|have just lost|just lost|are looking for|miss|can't find|cannot find|have not found|"
    "haven't found|have been looking for",
    "sorry": "sorry|so sorry|i'm sorry|i am sorry|i'm so sorry|terribly sorry|i hate|i don't like|i do not like|"
    "i don't mean|"
    "i don't want|i do not want|forgive me|pardon me|apologies|my apologies",
    "bother": "to bother you|to trouble you|to disturb you|to interrupt|to ask|to be a bother|to be a nuisance|"
    "to be a pain|to bother you again|to trouble you again|for bothering you|for disturbing you|for the trouble|"
    "for interrupting|for asking|to be rude|to rush you|to nag",
    "praise": "a star|an angel|a dear|a darling|a love|a gem|the best|a lifesaver|a life saver|very kind|so kind|"
    "too kind|"
    "great|brilliant|wonderful|amazing|my hero",
    "good": "good|clever|nice|lovely",
    "animal": "dog|doggy|boy|girl|robot|drone|rover",
    "hope": "i hope|i do hope|we hope|hopefully|i trust",
    "fine": "that's ok|that's okay|that's all right|that's alright|that is ok|that is all right|that's fine|"
    "it's ok|it's all right|it's not too much trouble|that's not too much trouble|that is not too much trouble",
    "hoped": "this works|it works|that works|that makes sense|you are well|you're well|you can help|you can help me|"
    "you can help us|you understand|you can hear me|all is well",
    "thanks": "thanks|thank you|many thanks|thanks a lot|thanks so much|thank you so much|thank you very much|"
    "thanks a million|thanks a bunch|ta|cheers|bless you|god bless|god bless you|thanks in advance|"
    "thank you in advance|thank you kindly|thanks for your help|thank you for your help|much obliged|much appreciated",
    **COURTEOUS_CLASSES,
}  # fmt: skip
"""Classes of wordings, by the name that the patterns give them."""

HARMLESS: tuple[str, ...] = (
    "<am>(?: <very>| only| just)* <feeling>(?: today| now| these days)?",
    "<have> (?:a |an )?(?:<very> )?<ailing> <body>(?: today| these days)?",
    "<my> (?:poor |old )?<body> (?:is|are|feels|feel) (?:<very> )*<ailing>(?: today| these days| again| now)?",
    "<my> (?:<ailing> |poor |old )?<body> (?:<very> )?<ails>(?: <very>)?(?: today| these days| again| any more|"
    " anymore| now)?",
    "<have> (?:a |my |an )?(?:crutches|crutch|cast|walker|walking stick|stick|cane|wheelchair|zimmer frame|"
    "walking frame|"
    "broken leg|broken ankle|bad leg|bad knee|bad back|sprained ankle|plaster cast|sling)(?: today| now)?",
    "<i> (?:<very> )?<cannot> <manage>(?: <well>)*",
    "<it>(?: getting)?(?: so| very| really| quite| rather| pretty| awfully| terribly| just)* <late>(?: now| already)?",
    "<it> (?:just )?what i (?:need|want)",
    "(?:time is|time's) (?:short|running out|of the essence)",
    "there (?:is|isn't|is not) (?:no|much|any) time(?: to lose| to waste| left)?",
    "(?:we|i) (?:haven't got|don't have|have not got|do not have|haven't) much time(?: left)?",
    "every (?:minute|second|moment) counts",
    "(?:please )?(?:hurry|hurry up|be quick|don't be long|quick)",
    "(?:<hope>|if) <fine>",
    "<hope> <hoped>",
    "<sorry>(?: <very>)? <bother>",
    "<i> (?:know|realise|realize|understand|appreciate) (?:you're|you are|it's|it is|this is) "
    "(?:<very> )?(?:busy|late|early|a lot|a lot to ask|a bother|difficult|annoying|a nuisance)",
    "(?:it|he|she) (?:has|'s|deserves) (?:done|worked|earned|had)? ?(?:<very> )?(?:enough|hard|a rest|a break|its rest)"
    "(?: for)?(?: today| now| one day| already)?",
    "(?:it's|he's|she's) (?:done|worked|earned|had) (?:<very> )?(?:enough|hard|a rest|a break|its rest)"
    "(?: for)?(?: today| now| one day| already)?",
    "(?:it's|it is|that's|that is|we're|we are|i'm|i am)"
    "(?: all| quite| about| just)* (?:done|finished|wrapping|wrapping up|packing up|through|all right now)"
    "(?: (?:here|now|today|for today|for tonight|for now|for the day|lads|folks|everyone|everybody|with it|then|too))*",
    "(?:it's|it is) (?:one|two|three|four|five|six|late|early|midnight|the middle) (?:in the|at|of the) "
    "(?:morning|night|evening)",
    "(?:with )?no (?:last )?(?:known )?(?:position|location|whereabouts|fix|details|description|further details|"
    "more details|further information|other information|witnesses)",
    "<my> <body>(?: 's| is| are) in (?:plaster|a cast|a sling|bandages|a splint|a bandage)",
    "<my> <body> (?:won't|will not|can't|cannot) (?:carry|take|get) me(?: (?:over|up|down|out))? (?:there|that far|"
    "anywhere)",
    "bless (?:it|him|her|its heart|his heart|its little heart|you)",
    "(?:it|he|she) (?:has|'s) (?:walked|worked|run|carried|been going|been walking)(?: quite| more than)? "
    "(?:enough|a lot|far enough)(?: today| for today| now)?",
    "<my> <body> (?:won't|will not|don't|do not|can't|cannot) (?:carry|take|hold|bear) me(?: (?:so|that|very|too|"
    "all that|"
    "as))?(?: far| long)?(?: any more| anymore| these days| now| today){0,2}",
    "(?:the|my|our|a|his|her) (?:[a-z]+ ){0,2}[a-z]+ (?:is|are|has|have|feels) (?:<very> )*(?:thirsty|hungry|thirst|"
    "hunger|tired|parched|a fever|a headache|a sore throat)",
    "(?:its|his|her|your) (?:shift|day|work|job|round|turn|duty|rounds) (?:is|are) (?:over|done|finished|up)"
    "(?: now| for today)?",
    "(?:it's|it has|he's|he has|she's|she has) been (?:out|working|busy|running|on the go|at it) (?:<very> )*"
    "(?:long|long enough|all day|all morning|hard|enough|a while)(?: now| already)?",
    "that's (?:it|all|enough) (?:i think|then|i guess|i suppose|folks|everyone|everybody|lads)",
    "that's (?:all|everything|the lot)(?: (?:i|we) (?:need|want|ask|ask for|wanted|needed))?(?: for now| today)?",
    "(?:let's|let me|let us) see|let me think|i've seen (?:quite )?enough|that's (?:enough|all|it)(?: for today| now)?",
    "(?:you|he|she|it|they) (?:must|might|will) be (?:<very> )*<feeling>(?: by now| now| already| too| today)?",
    "(?:it|he|she|you) (?:has|have|'s|'ve) (?:earned|deserved) (?:it|that|this|one|a rest|a break)",
    "(?:it's|he's|she's|you've) (?:earned|deserved) (?:it|that|this|one|a rest|a break)",
    "(?:just |or )?(?:whenever|when) (?:you're|you are) ready",
    "like|honestly|literally|seriously|basically|frankly|kinda|kind of|sort of|you see|if you like",
    "how are you(?: today| doing| doing today)?",
    "(?:<i> )?(?:really |do |much )*appreciate (?:it|that|this|your help|the help)",
    "(?:you're|you are) <praise>",
    "<good> <animal>",
    "emergency|an emergency|mayday|this is an emergency|thank god|thank god (?:you're|you are) here|"
    "well done|nice work|good job|great job|good work|what a day|oh my|oh no|dear god|help|help me|no rush|"
    "there's no rush|"
    "there is no hurry|no hurry|take your time|as always|as usual|if i may ask|if i may|so to speak|you see|you know",
    "(?:<thanks>)(?: <thanks>)*",
)
"""Clauses that are left out, in any crew. `<name>` stands for a class."""

OWN_CHOICE: tuple[str, ...] = (
    "(?:you can |you may |feel free to |please |just )*(?:use|take|pick|choose) "
    "(?:whichever|whatever|any|any of the)(?: (?:units?|robots?|machines?|vehicles?|one|ones))?"
    "(?: (?:you|it) (?:want|wants|like|likes|prefer|please|think best|think is best|see fit|wish|fancy))?",
    "(?:i don't mind|i do not mind|it doesn't matter|it does not matter|i don't care|"
    "i do not care|"
    "no matter) (?:who|which|which one|which robot|which of you|which unit)"
    "(?: (?:of you )?(?:does it|goes|does|takes it|brings it|it is))?",
    "whichever (?:one|robot|unit)? ?(?:you (?:want|like|prefer|please)|suits)",
)
"""Clauses that leave the choice of the robot to the crew, which has it anyway."""

ABOUT_A_PERSON: tuple[str, ...] = (
    "(?:<whose> )?(?:<poor> )*@persons? (?:<very> )?<gone>",
    "(?:we|i|they|we've|i've|they've|<whose> (?:<poor> )*@persons?) <lost> <whose> (?:<poor> )*@persons?",
    "(?:someone|somebody|one) (?:<gone>)",
    "(?:someone|somebody|(?:<whose> )?(?:<poor> )*@persons?) 's (?:<very> )*(?:<astray>)",
    "(?:one|a member) of (?:my|our|the|his|her|their|these) (?:<poor> )*@persons (?:<gone>)",
    "(?:he|she|they) (?:<gone>)",
    "(?:he's|she's|they're|they've|he has|she has|they have|he is|she is|they are) (?:<very> )*(?:<astray>)",
    "(?:he's|she's|he is|she is) (?:only |just |about |around |nearly |almost |already )?<age>",
    "(?:we're|we are|i'm|i am) (?:missing|short of|down) <whose> (?:<poor> )*@persons?",
    f"(?:<whose> )?(?:<poor> )*@persons?(?: <gone>)? {REPORTED}",
    "(?:it's|it is|that's|that is|this is) (?:<whose> )(?:<poor> )*@persons?",
    "<have> (?:someone|somebody|<whose> (?:<poor> )*@persons?) (?:missing|lost|overdue)",
    "(?:there is|there's) (?:someone|somebody|<whose> (?:<poor> )*@persons?) (?:missing|lost|overdue)",
    "<am> (?:<very> )*(?:worried|concerned|anxious|scared) (?:about|for) <whose> (?:<poor> )*@persons?",
)
"""Clauses that are left out where a crew looks for a person, who is kept for `him` and `her`.

`@person` and `@persons` stand for a noun of one; since when, and from where, may follow (`closed_kinds.py`).
"""

_OCCASION = (
    "film|show|demo|demonstration|test|tests|experiment|report|class|course|lesson|exercise|drill|training|visitors|"
    "guests|audience|cameras|camera|children|kids|students|record|log|logbook|journal|crowd|next part|second part|"
    "exercises|rehearsal|recording|review|survey|calibration|check|checks|acceptance|assembly|inspection|"
    "first part|next run|next step|next test|shoot|scene|take|broadcast|programme|presentation|tour|party|meeting|paper"
)
PURPOSES: tuple[str, ...] = (
    f"for (?:the |our |my |a |an |this |today's |your |these |"
    f"those )?(?:[a-z]+ ){{0,2}}(?:{_OCCASION})(?: of (?:the |our |my )?(?:{_OCCASION}))?",
)
"""Clauses that say on what occasion something is wanted."""

OUT_OF_REACH: tuple[str, ...] = ("<i> <cannot> (?:quite )?(?:reach|get to|get at|lift|carry|hold|fetch|find)",)
"""What the person cannot do with the thing that is then asked for."""
CALLED: tuple[str, ...] = ("assign|assigning|task|tasking|detail|detailing|calling|attention|attn|come in",)
"""What stands in front of the robot that is called."""

_LABEL = "task|order|job|incident|situation|mission|request|assignment|tasking|instruction|instructions|message|"
"work order|priority|"
"action|objective"
HEADINGS: tuple[str, ...] = (
    f"(?:new|next|your|the|my|another|a|one|priority|urgent|today's|first)? ?(?:{_LABEL})(?: is|"
    f" number one)?(?: (?:number |no )?[0-9]+)?",
    f"(?:new|next|your|the|my|another|a|one|priority|urgent)? ?(?:priority |urgent )?(?:{_LABEL}) for",
)
"""What stands before a colon, alone or with the robot that is called."""
LABELS: frozenset[str] = frozenset(
    (
        "task",
        "order",
        "job",
        "mission",
        "request",
        "assignment",
        "tasking",
        "operation",
        "run",
        "test",
        "trial",
        "check",
        "demo",
        "experiment",
        "exercise",
        "duty",
        "errand",
        "round",
    )
)
"""Nouns behind the noun of an action, in `transport order:`; they say nothing."""
NEW: frozenset[str] = frozenset(("new", "next", "priority", "urgent", "another"))
"""Adjectives in front of it."""

JOINED: frozenset[str] = frozenset(("so", "and", "but", "because", "cause", "'cause", "since", "as", "for", "well"))
"""Words that may stand in front of such a clause and go with it, where a clause begins behind them."""
SPEAKS: frozenset[str] = frozenset((
    "i", "we", "i'm", "we're", "it", "it's", "my", "our", "this", "that's", "i've", "i'd", "we've", "time", "there",
    "every",
))  # fmt: skip
"""What follows `as`, `since` and `for` where they give a reason."""

SUBJECTS: frozenset[str] = frozenset((
    "i", "we", "he", "she", "they", "it", "this", "that", "there", "i'm", "we're", "i've", "we've", "it's", "he's",
    "she's",
    "they're", "that's", "there's", "i'd", "you're", "i'll", "they've",
))  # fmt: skip
POSSESSORS: frozenset[str] = frozenset(("my", "our", "his", "her", "their", "the", "a", "an", "some"))
FINITE: frozenset[str] = frozenset((
    "is", "are", "was", "were", "has", "had", "have", "am", "be", "been", "will", "would", "could", "might", "may",
    "can", "does", "did",
    "says", "said", "told", "thinks", "knows", "likes", "wants", "needs", "looks", "feels", "seems", "gets", "got",
    "makes",
    "hates", "loves", "works", "keeps", "came", "went", "took", "gave", "saw", "left", "hurts", "isn't", "aren't",
    "wasn't", "hasn't",
    "haven't", "hadn't", "can't", "don't", "doesn't", "didn't", "won't", "wouldn't", "couldn't", "just", "always",
    "really", "never",
))  # fmt: skip
"""Verbs by which a clause is told and not asked for, behind a subject that is no robot."""


def told_words() -> frozenset[str]:
    """Every word of the closed kinds: none of them is a slip."""
    return NO_SLIPS | frozenset(w for said in CLASSES.values() for w in re.findall(r"[a-z']+", said))
