"""Word lists of the reader: function words by what they do, number words, units. Data only, no logic."""

from enum import StrEnum

from crew.contracts.language.frames import FRAMES, OPENINGS, PRESENTED, TAGS, WHEREABOUTS, phrases


class Role(StrEnum):
    """What a word or phrase does in a request, when it names nothing by itself."""

    FILLER = "filler"
    OPENER = "opener"
    """A filler at the beginning of a clause, or all of it; anywhere else it may change what is meant."""
    CLOSER = "closer"
    """A filler at the end of a sentence."""
    PRESENTED = "presented"
    """A filler before the person to be found: `we have a`."""
    WHEREABOUTS = "whereabouts"
    """A filler behind that person: `last seen`."""
    MODAL = "modal"
    BE = "be"
    CAUSE = "cause"
    DETERMINER = "determiner"
    QUANTIFIER = "quantifier"
    TO = "to"
    AT = "at"
    OVER = "over"
    NEAR = "near"
    FROM = "from"
    WITH = "with"
    OF = "of"
    FOR = "for"
    AND = "and"
    THEN = "then"
    AFTER = "after"
    BREAK = "break"
    NOT = "not"
    NO = "no"
    EXCEPT = "except"
    AVOID = "avoid"
    CONDITION = "condition"
    ALTERNATIVE = "alternative"
    CORRECTION = "correction"
    PRONOUN = "pronoun"
    WHOEVER = "whoever"
    EVERYTHING = "everything"
    LIGHT = "light"
    FIRST = "first"
    PUNCTUATION = "punctuation"
    WORD = "word"
    UNREAD = "unread"
    MENTION = "mention"


FUNCTION_WORDS: dict[Role, tuple[str, ...]] = {
    Role.FILLER: (
        "please", "pls", "kindly", "hey", "hi", "hello", "ok", "okay", "alright", "thanks", "thank you",
        "thank you very much", "thanks a lot", "many thanks", "cheers", "could you", "can you", "would you",
        "will you", "could you please", "can you please", "would you mind", "would you please", "you", "i", "we",
        "i need you to", "i want you to", "i would like you to", "i'd like you to", "i'd like", "i would like",
        "i would like to", "i'd like to", "i need to", "i want to", "we need to", "we want to", "we need you to",
        "we want you to", "i want", "i need", "we need", "we want", "let's", "let us", "lets", "now", "right now",
        "immediately", "right away", "at once", "asap", "as soon as possible", "straight away", "for me please",
        "tell me", "show me", "let me know", "inform me", "why don't you", "why do not you", "don't forget to",
        "do not forget to", "make sure to", "make sure that", "make sure", "be sure to", "do", "so", "well",
        "go ahead", "if you please", "if you can", "if possible", "nothing else", "nothing more", "too", "as well",
        "good morning", "good afternoon", "good evening", "dear", "also", "it is time to", "time to",
        "your task is to", "your job is to", "your mission is to", "the task is to", "you have to", "you need to",
        "it would be nice to", "it would be great to", "it would be nice if you could", "if you could",
        "it is necessary to", "it is important to",
        "it would be great if you could", "has to", "needs to", "have to", "need to", "the job is to", "take care to",
        "be so kind", "be so kind as", "be so kind and", "could someone", "could somebody", "can someone",
        "can somebody", "would someone", "would somebody", "you can", "you may", "you guys", "please to",
        "would it be possible to", "would it be possible for you to", "is it possible to", "may i ask you to",
        "might i ask you to", "could i ask you to", "can i ask you to", "i would like to ask you to",
        "if it is not too much trouble", "if it's not too much trouble", "if you don't mind", "if you do not mind",
        "if you would", "if you would be so kind", "if you would be so kind as to", "be so good as to",
        "be so kind as to", "would you be so kind as to", "would you be so good as to", "could you be so kind as to",
        "i would be grateful if you could", "i would be most grateful if you could", "i'd be grateful if you could",
        "i would be very grateful if you could", "i would be happy if you could", "i'd be happy if you could",
        "i would appreciate it if you could", "i'd appreciate it if you could", "i would appreciate it if",
        "i'd appreciate it if", "it would be great if", "it would be nice if", "it would help if you could",
        "i wonder whether you could", "i wonder if you could", "i was wondering if you could",
        "i was wondering whether you could", "do you think you could", "would you be able to", "are you able to",
        "could you possibly", "see to it that", "please see to it that", "we need that",
        "i should like", "i should like to", "do me a favor and", "do me a favour and", "thank you for", "thanks for",
        "let me think", "there is", "there are", "there's", "what you are doing", "what you're doing",
        "whatever you are doing", "whatever happens", "whatever you do", "you know", "as i said", "yes please",
        "would you mind please", "could we", "can we", "can we please", "could we please", "may we", "will you please",
        "your turn", "the plan is to", "the idea is to", "all i want is", "all i need is", "what i want is",
        "what i need is", "you should", "you must", "you will", "you shall", *phrases(FRAMES),
    ),
    Role.OPENER: (
        "um", "uh", "uhm", "er", "erm", "hmm", "hm", "mm", "ah", "oh", "eh", "yeah", "yes", "yep", "yup", "yea",
        "right", "right then", "okay then", "ok then", "so then", "look", "listen", "look here", "come on", "excuse me",
        "pardon me", "basically", "like", "well then", "fine", "good", "great", "perfect", "cool", "alright then",
        "team", "folks", "guys", "everyone", "buddy", "mate", "friend", "friends", "my friend", "crew", "attention",
        "anyway", "now then", "and now", "yo", "hurry", "hurry up", "quick question", "question",
        "that's enough", "that is enough", "enough", "will you", "if you will", *phrases(OPENINGS),
    ),
    Role.CLOSER: tuple(phrases(TAGS)),
    Role.PRESENTED: tuple(phrases(PRESENTED)),
    Role.WHEREABOUTS: tuple(phrases(WHEREABOUTS)),
    Role.MODAL: ("should", "shall", "must", "can", "could", "would", "ought"),
    Role.BE: ("be", "been", "were", "is", "are", "has", "have", "has been", "have been", "get", "gets"),
    Role.CAUSE: ("have", "get", "let", "ask", "tell", "order", "command", "instruct", "make", "use", "want", "need"),
    Role.DETERMINER: ("the", "a", "an", "this", "that", "these", "those", "my", "your", "our", "some", "any"),
    Role.QUANTIFIER: ("all", "both", "every", "each", "whole", "entire", "complete", "full"),
    Role.TO: ("to", "into", "onto", "toward", "towards", "over to", "back to", "up to", "to where"),
    Role.AT: ("at", "in", "on", "inside", "within", "in the direction", "somewhere in", "somewhere inside"),
    Role.OVER: (
        "over", "across", "throughout", "through", "around", "round", "all round", "all over", "all around",
        "all across",
    ),
    Role.NEAR: ("near", "beside", "next to", "close to", "near to"),
    Role.FROM: ("from", "out of"),
    Role.WITH: ("with", "using", "by", "via", "with the help of"),
    Role.OF: ("of",),
    Role.FOR: ("for",),
    Role.AND: ("and", "plus"),
    Role.THEN: (
        "then", "next", "afterwards", "afterward", "after that", "after this", "finally", "later", "and then",
        "subsequently", "and afterwards", "and after that", "and finally", "and next", "when done", "once done",
    ),
    Role.AFTER: ("once", "when", "after", "as soon as"),
    Role.BREAK: ("but", "however", "instead", "just", "only", "simply", "yet", "though", "although"),
    Role.NOT: (
        "not", "never", "don't", "dont", "do not", "doesn't", "does not", "didn't", "mustn't", "shouldn't", "can't",
        "cannot", "can not", "won't", "wouldn't", "couldn't", "isn't", "aren't", "needn't", "shan't", "without",
        "neither", "nor", "nothing", "nobody", "none", "no one", "no need to", "do n't", "refrain from", "hardly",
        "did not", "doesnt", "didnt", "cant", "wont", "isnt", "arent", "shouldnt", "mustnt", "wouldnt", "couldnt",
        "neednt", "nowhere",
    ),
    Role.NO: ("no",),
    Role.EXCEPT: (
        "except", "except for", "excluding", "apart from", "other than", "rather than", "instead of", "but for",
        "not including", "all but", "no need for", "there is no need for", "i don't need", "we don't need",
        "anywhere but", "everywhere but", "everything but", "anything but", "aside from", "save for", "minus", "less",
    ),
    Role.AVOID: (
        "avoid", "avoiding", "skip", "skipping", "stay away from", "keep away from", "keep out of", "stay out of",
        "leave out", "leaving out", "away from", "stay clear of", "keep clear of", "ignore", "ignoring", "omit",
        "omitting", "forbid", "forbidden", "prevent", "preventing", "prohibit", "outside", "outside of", "beyond",
    ),
    Role.CONDITION: (
        "if", "unless", "until", "till", "before", "in case", "whether", "provided", "assuming", "otherwise", "else",
        "as long as", "depending", "except if", "only if", "even if", "what if",
    ),
    Role.ALTERNATIVE: ("or", "either", "and or"),
    Role.CORRECTION: (
        "no wait", "wait", "actually", "i mean", "i meant", "sorry", "scratch that", "correction", "never mind",
        "nevermind", "on second thought", "on second thoughts", "oops", "my mistake", "forget", "forget it", "undo",
        "strike that", "or rather", "disregard", "not only", "not just", "changed my mind", "hang on", "hold on",
    ),
    Role.PRONOUN: ("it", "them", "him", "her", "they", "there", "over there", "its", "their", "his"),
    Role.WHOEVER: (
        "whoever", "whomever", "anyone", "anybody", "someone", "somebody", "any one", "anyone that", "anyone who",
    ),
    Role.EVERYTHING: ("everything", "everyone", "everybody", "all of them"),
    Role.LIGHT: (
        "start", "begin", "perform", "conduct", "execute", "do", "make", "makes", "does", "starts", "begins",
        "performs",
        "conducts", "making", "doing", "performing", "conducting", "starting", "takes", "has", "runs", "go up",
        "fly up",
        "head out", "set off", "get going", "kick off", "carry on", "continue with", "proceed with", "get on with",
        "get started", "fly around", "fly about", "fly off", "fly over there", "go around", "go off", "go up there",
        "fly up there", "get out there", "get up there", "get over there", "head off", "head over there",
        "go out there", "head out there", "fly out there", "mount",
        "embark on", "go over there", "go round", "fly out", "have", "take", "run", "go",
        "come", "try",
        "proceed", "carry out", "commence", "initiate", "undertake", "organise", "organize", "arrange", "go on",
        "go out", "go ahead", "give", "start by", "begin by", "continue",
    ),
    Role.FIRST: ("first", "firstly", "first of all", "to begin with", "to start with"),
}  # fmt: skip
"""Phrases by role. A phrase may stand under several roles (`have`, `do`): the reader picks by what follows."""

ROLE_ORDER: tuple[Role, ...] = (
    Role.LIGHT, Role.CAUSE, Role.BE, Role.OPENER, Role.CLOSER, Role.PRESENTED, Role.WHEREABOUTS,
)  # fmt: skip
"""Roles that hold only before a fitting word; tried in this order before the plain roles."""

SILENT = frozenset((Role.FILLER, Role.OPENER, Role.DETERMINER, Role.AND, Role.MODAL))
"""Roles of words whose slips change nothing."""
LINKING = frozenset((Role.PRONOUN, Role.TO, Role.AT, Role.FROM, Role.OVER, Role.NEAR, Role.WITH, Role.THEN, Role.AFTER))
"""Roles of words that name nothing, and whose slips are recognised where two letters were swapped."""
TURNING = frozenset((Role.NOT, Role.NO, Role.EXCEPT, Role.AVOID, Role.CONDITION, Role.ALTERNATIVE, Role.CORRECTION))
"""Roles of words that turn a request round."""

REQUESTER = "requester"
"""The run-time value that the speaker's own words name."""
SELF_WORDS: tuple[str, ...] = ("me", "here", "over here", "right here", "myself", "us")

ROBOT_WORDS: tuple[str, ...] = ("robot", "vehicle", "machine", "unit")
"""Class words that every crew has: any of its robots."""


def word_set(text: str) -> frozenset[str]:
    return frozenset(text.split())


ADVERBS: frozenset[str] = word_set(
    "twice thrice again once more often always forever fast slow quick soon tomorrow today tonight "
    "yesterday x y maybe perhaps already still almost least most very really exactly about roughly up down "
    "out off away back"
)
"""Words that change how, when or how often. They are never read, and never part of a name."""

ZONE_NOUNS: tuple[str, ...] = ("half", "part", "side", "section", "area", "zone", "region", "sector", "portion")
"""Nouns that are interchangeable at the end of a zone's name, when no other zone bears that name."""

LEFT_ALONE: tuple[tuple[str, ...], ...] = tuple(
    tuple(tail.split())
    for tail in (
        "where it is", "where they are", "where he is", "where she is", "as it is", "as they are", "alone", "in peace",
        "in place", "behind", "still", "there", "out of this", "out of it", "untouched",
    )
)  # fmt: skip
"""What follows a name in `leave the cube where it is`, `keep the rover still`: the thing is to be left out."""
AFFECTIVE: frozenset[str] = word_set(
    "nice little good dear lovely poor clever trusty brave sweet cute friendly old dearest"
)
"""Adjectives that tell how somebody feels about a robot or a person, and pick none out."""
QUALITIES: frozenset[str] = word_set("quick good full thorough proper careful complete detailed close systematic")
"""Adjectives of a search that no skill here can heed, and that none would refuse."""
NICKNAMES: dict[str, tuple[str, ...]] = {
    "dog": (
        "doggy", "doggie", "doggo", "pup", "puppy", "hound", "pooch", "robodog", "quadrupedal robot", "dog robot",
        "four legged robot", "four legged one", "four legged friend", "four legged machine", "four legged fellow",
        "robot with four legs", "one with four legs", "one with the four legs", "one on four legs", "robot hound",
        "four legged dog", "four legged thing", "four legger", "dogbot", "dog bot", "robo dog", "small robot",
        "smaller robot", "walking robot", "four legged helper",
    ),
    "robot": ("bot", "droid"),
    "drone": (
        "uav", "helicopter", "chopper", "quadrocopter", "multicopter", "aircraft", "flyer", "aerial vehicle",
        "flying machine", "flying robot", "flying thing", "flying device", "flying camera", "flying one",
        "flying contraption", "air robot", "flying vehicle", "flying gadget", "whirlybird", "flying bot",
    ),
    "rover": (
        "buggy", "ground vehicle", "ground unit", "wheeled robot", "ground robot", "rover car", "rover robot",
        "rover vehicle", "wheeled one", "one on wheels", "wheeled vehicle", "wheeled machine", "driving robot",
        "driving one", "robot car", "robot buggy", "driving machine", "rolling robot",
    ),
    "humanoid": (
        "android", "two legged robot", "two legged one", "robot with two legs", "one with two legs", "big robot",
        "bigger robot", "big one", "tall one",
        "tall robot", "taller robot", "large robot", "robot with arms", "one with arms",
        "robot with the arms", "one with the arms", "robot with hands", "one with hands", "one with the hands",
        "robot with the arm", "one with the arm", "human like robot", "humanlike robot", "manlike robot",
        "two legged machine", "two legged fellow", "standing robot", "two armed robot", "robot man",
    ),
}  # fmt: skip
"""What people call a class of robots beside its aliases."""
IN_NEED: frozenset[str] = word_set("hurt injured lost missing wounded stranded trapped overdue there")
"""What `whoever is ...` may say of the person that is to be found."""
BEFALLEN: tuple[tuple[str, ...], ...] = tuple(
    tuple(said.split())
    for said in ("is", "has got", "got", "has gone", "has been", "has gotten", "went", "is out there")
)
"""What stands between `someone` and that need."""
NOTHING_SAID: frozenset[str] = word_set("anywhere anything whatsoever else ever")
"""Words that add nothing inside a negation."""

PLACE_NOUNS: frozenset[str] = word_set(
    "position positions location coordinates coordinate point spot place whereabouts waypoint goal"
)
"""Nouns that stand for the place of what follows or precedes them."""

IRREGULAR: dict[str, tuple[str, ...]] = {
    "find": ("found",), "send": ("sent",), "drive": ("drove", "driven"), "fly": ("flew", "flown"),
    "go": ("went", "gone"), "bring": ("brought",), "take": ("took", "taken"), "give": ("gave", "given"),
    "tell": ("told",), "hold": ("held",), "freeze": ("froze", "frozen"), "get": ("got", "gotten"),
    "put": ("put",), "come": ("came", "come"), "sweep": ("swept",), "lead": ("led",), "leave": ("left",),
    "seek": ("sought",), "bear": ("bore", "borne"), "shake": ("shook", "shaken"),
}  # fmt: skip
"""Past forms that the regular rule does not make."""

PARTICLES: frozenset[str] = word_set("up down off back over out")
"""Second parts of a verb that may stand behind its object ("bring the drone down")."""

METRES: frozenset[str] = word_set("m metre metres meter meters")
OTHER_UNITS: frozenset[str] = word_set(
    "ft feet foot km kilometre kilometres kilometer kilometers cm mm centimetre centimetres centimeter "
    "centimeters yd yard yards mile miles mi inch inches deg degree degrees rad s sec second seconds "
    "min minute minutes h hour hours percent times hundred thousand million dozen half quarter k am pm "
    "oclock o'clock mph kmh kph knots nm people persons victims robots drones rovers"
)
"""What makes a number unreadable here: another unit, a multiple, a count."""

_SMALL = (
    "zero one two three four five six seven eight nine ten eleven twelve thirteen fourteen fifteen sixteen seventeen "
    "eighteen nineteen"
)
DIGIT_WORDS: dict[str, int] = {word: value for value, word in enumerate(_SMALL.split())}
TENS_WORDS: dict[str, int] = {
    "twenty": 20, "thirty": 30, "forty": 40, "fifty": 50, "sixty": 60, "seventy": 70, "eighty": 80, "ninety": 90,
}  # fmt: skip

SINGLE_WORDS: frozenset[str] = frozenset(
    (*ADVERBS, *ZONE_NOUNS, *IN_NEED, *NOTHING_SAID, *PLACE_NOUNS, *METRES, *OTHER_UNITS, *DIGIT_WORDS, *TENS_WORDS)
) | word_set("he she who what where which why how that was were been did does seen altitude height axis axes x y")
"""Words that other parts of the reader know: none of them is a slip of another."""
