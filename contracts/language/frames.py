"""What people say around a request: courtesy, procedure words of the radio, spoken filling. Templates, no logic.

Each frame leaves what is asked for as it is. Whatever could change it (a condition, a time, a manner) stays out.
"""

from collections.abc import Iterator
from functools import cache

from crew.contracts.language.templates import expansions

FRAMES: tuple[str, ...] = (
    "(i would|i'd|we would|we'd|i should|we should) be (|very |most |so |really |much )"
    "(grateful|obliged|thankful|happy|glad|pleased|delighted) (if|if you|if you could|if you would)",
    "(would it be|is it|will it be) (|at all )(possible|all right|alright|ok|okay|fine|too much trouble) "
    "(to|for you to|if|if you|if you could|if you would)",
    "(when|whenever|if) you (have|get|find) (a moment|a minute|a second|a sec|time|the time|a chance|the chance)",
    "(when|whenever) you (can|are ready|are free|like)",
    "(at your convenience|in your own time|by all means|by any chance)",
    "(be|would you be|could you be|do be|please be|will you be|can you be) (a|an|my) (|good |real |dear |little |"
    "clever |nice |sweet )"
    "(dear|darling|love|sport|angel|friend|sweetheart|sweetie|star|pet|treasure|hero|help|dog|doggy|robot|"
    "boy|girl|lad|lass|chap|fellow|man|mate|pal|soul|honey|lamb|champ|gem|helper|drone|rover) and",
    "(be|do be|please be|would you be|will you be) (so |very |)(good|kind|nice|sweet|helpful|lovely) (and|enough to)",
    "(could|can|may|might) (i|we) (|please |kindly )(ask|beg|request|bother|trouble|get) you to",
    "(i|we) (must|have to|would|want to|would like to|would just like to) (ask|request|beg|tell|instruct) you to",
    "(i|we) (want|need|wish|would like|require|would prefer) that",
    "(i'd|we'd) (like|prefer) that",
    "(i'm|i am|we're|we are) (needing|wanting)",
    "make (|it |sure |so |it so )that",
    "(it is|it's) (|very |really )(needed|necessary|required|important|essential|imperative) (to|that|for you to)",
    "(it would be|that would be|it is) (|very |most |so )"
    "(kind|nice|good|helpful|sweet|lovely|decent) of you (to|if you could)",
    "(would|could|can|will) (one|any|either) of you (|please |kindly )(|be so kind as to |be kind enough to |mind )",
    "would it (trouble you|be a bother|be a nuisance|be too much|be a trouble|kill you) (|for you )to",
    "is there any (way|chance|possibility) (that |)(you|we) (could|can|might)",
    "(i'm|i am|we're|we are) (asking|telling|ordering|requesting|instructing|begging) you to",
    "(i|we) (ask|order|tell|instruct|command|beg) you to",
    "(could|can|would) you (maybe|perhaps|possibly) (|sort of |kind of |just )",
    "(may|might|could|can) (i|we) ask (|you )for (a|an|the)",
    "do you (think|suppose|reckon) you (could|can|might|would)",
    "would you (care|be willing|be so kind as|be good enough) to",
    "if (it's|it is|it isn't|it is not|that's|that isn't|that is not) (too much|any|a|not too much) (trouble|bother|"
    "hassle)",
    "(i'd|i would|we'd|we would) (feel|be) (so |so much |much |a lot )(better|happier|easier) if (|you could|"
    "you would)",
    "(perhaps|maybe) (you|we|someone) (could|can|might)",
    "(do|would) you mind",
    "(|i |we |you )(want|wanna) to",
    "(it|that) would help (me|us) (|very much |a lot |greatly |so much |no end )if (|you could |you )",
    "(pretty please|abeg|biko|pleeease|pleease|prithee)",
    "if (it's|it is) (no|not a|no great|no big) (trouble|bother|problem|hassle|bother at all|trouble at all)",
    "(let's try|let us try)",
    "be able to",
    "(you know what|i tell you what|tell you what|the thing is|long story short|to be honest|if i may)",
    "(i'm |i am |we're |we are )(going to|definitely going to|just going to) (need|want)",
    "(it|that) would be (|so |very |really |most )(great|nice|lovely|wonderful|perfect|fantastic|"
    "brilliant|"
    "super|good|kind|helpful|marvellous|splendid|a great help|a big help|a help) (if|if you could|if you would|"
    "if you can|to)",
    "(it|that) would (help|please me|make me happy|make my day|mean a lot) (if|if you could|if you would|to)",
    "(i|we) would (appreciate|love|like|prefer) it (|very much |so much |greatly )(if|if you could|if you would)",
    "(i'd|we'd) (appreciate|love|like|prefer) it (|very much |so much |greatly )(if|if you could|if you would)",
    "(from|out of) (the air|above|the sky|high up|up high|up there)",
    "(by air|aerial|aerially|an aerial)",
    "(i need|we need|i want|we want) (someone|somebody|one of you) to",
    "(if|when) you (can|could) (spare|find) (a moment|a minute|the time|a second)",
    "(|would |could |can )(someone|somebody|anyone|anybody) (please|kindly)",
    "(your next|the next|your first|your new|today's) (job|task|mission|order) is to",
    "(it is|it's) (about |high |)time (to|for|you|we|that you)",
    "(i was|i am|i'm|we were) (hoping|wondering|thinking) (that |if |)(you could|you might|you would|we could|"
    "someone could)",
    "do (me|us) (a|the) (favour|favor|kindness) (and|of)",
    "(it falls to you|it is up to you|it's up to you) to",
    "(i|we) (need|want|would like) (you|you guys|the team|the crew|your team) to",
)
"""Said before a request, or between its parts."""

OPENINGS: tuple[str, ...] = (
    "(dear me|oh dear|my goodness|goodness|goodness me|heavens|oh my|well now|now now|all right)",
    "(i'm|i am|we're|we are) (|so |very |really |quite |a bit )"
    "(thirsty|hungry|tired|cold|busy|worried|in a hurry|running late|new here)",
    "(roger|roger that|copy|copy that|affirmative|affirm|wilco|break|break break|radio check|say)",
    "next (up|job|task|order) (|is)",
    "(uh huh|huh|mm hmm|righty ho|right oh|righto|okey doke|okey dokey|alrighty|alrighty then|rightyho|aye)",
    "(request|requesting|i request|we request|i am requesting|we are requesting|i hereby request|asking for|"
    "we are asking for)",
    "(as for|regarding|concerning|as regards|with regard to)",
    "(you there|hey you|you guys|you're up|you are up|over to you|your move|it's your turn)",
    "(caller|dispatch|police|witness|witnesses|command) (reports|reporting)",
    "(all stations|all callsigns|all call signs|say again|i say again|i repeat|be advised|for your action)",
    "(son|lad|laddie|lassie|dearie|my boy|my girl|my lad|my son|young lady|young fellow|young woman|good fellow|"
    "old chap|old boy|kiddo|sweetheart|petal|pet|good man|my good man|my good fellow|ladies|lads|boys|chaps)",
    "(mr|mister|miss|mrs|sir|madam|ma'am|dude|bro|boss|chief|pal|love|honey|sweetie|darling|my dear|young man|team|"
    "gentlemen|ladies and gentlemen)",
)
"""Said where a clause begins."""

TAGS: tuple[str, ...] = (
    "(will|would|won't|can|could|can't|wouldn't|couldn't) you",
    "(ok|okay|all right|alright|right|yes|yeah|eh|huh|got it|understood|clear|is that clear)",
    "(is that|if that's|if that is|if it is|if it's) (ok|okay|all right|alright|fine|possible|not too much trouble)",
    "(that would be|that'd be|it would be) (great|nice|lovely|perfect|wonderful|kind|all)",
    "(that's|that is) (all|it|everything)",
    "there's a (dear|love|darling|good boy|good girl|good lad|good dog|good fellow|good chap|good man|good one)",
    "(thanks so much|thank you so much|much obliged|much appreciated|thanking you|thank you kindly)",
    "(over|out|over and out|how copy|do you copy|acknowledge|acknowledged|roger|wilco|stand by|standing by)",
    "and stand by",
    "(|please )(read back|confirm|acknowledge|read it back|confirm receipt|confirm please|acknowledge please)",
    "(|control |ops |command |dispatch )(out|over and out|clear and out)",
    "(end of message|message ends|end message|end of order|that's your task|that is your task)",
    "(urgent|urgently|this is urgent|it's urgent|high priority|top priority|standby|please respond|do you read|"
    "come in)",
    "(sir|madam|ma'am|dude|bro|boss|chief|pal|love|honey|sweetie|darling|my dear|mate|buddy|man|guys|folks|my friend)",
    "(will|can|could|would|won't) ya",
    "(can't|couldn't) (he|she|it|they)",
)
"""Said where a sentence ends, and nothing follows."""

PRESENTED: tuple[str, ...] = (
    "(we have|we've|we have got|we've got|we got|we are missing|we're missing|we lost|we have lost|we've lost|"
    "i have|i've got|there is|there's|they have|they lost|we are looking for|we're looking for) (a|an|one)",
    "(reports of|report of|reported|a report of|we have reports of|we have a report of) (a|an|one)",
    "(caller|witness|witnesses|police|a caller|somebody|someone) (reports|report|reported) (a|an|one)",
)
"""Said in front of the person who is to be found."""

WHEREABOUTS: tuple[str, ...] = (
    "(|is |was |were |has been )last (seen|spotted|sighted|located|heard from|heard of|contact|position|"
    "known position|sighting)",
    "(|is |was |has been )(seen|spotted|sighted|reported|reported missing|reported lost|reported overdue|overdue|"
    "believed lost)",
    "(|is |was |went |has gone |gone |got |has got )(missing|lost|stranded|trapped)",
    "(is|must be|should be|is probably|might be|may be|could be|is likely|is believed to be|"
    "is thought to be) somewhere",
    "(is|must be|should be|is probably|might be|may be|could be|is likely to be|is believed to be|is thought to be)",
    "(|most )(probably|possibly|likely|presumably|apparently|reportedly|supposedly)",
)
"""Said behind that person."""

BEFORE_A_MARK = frozenset((
    "son", "lad", "laddie", "my boy", "my girl", "my lad", "my son", "young lady", "young woman", "lads", "boys",
    "chaps",
    "ladies", "good man", "young fellow", "copy", "say", "break", "roger", "affirm",
))  # fmt: skip
"""Openings that are verbs or names without a mark behind them."""
AFTER_A_MARK = frozenset(
    (
        "over",
        "out",
        "right",
        "clear",
        "roger",
        "yes",
        "eh",
        "huh",
        "man",
        "chief",
        "pal",
        "love",
        "mate",
        "can't he",
        "can't she",
        "can't it",
        "can't they",
        "couldn't he",
        "couldn't she",
        "couldn't it",
        "couldn't they",
    )
)
"""Tags that would belong to what stands in front of them, were there no mark between."""


def phrases(templates: tuple[str, ...]) -> Iterator[str]:
    """Every wording, with single blanks."""
    return (" ".join(wording.split()) for template in templates for wording in expansions(template))


@cache
def framing() -> frozenset[str]:
    """Courtesy and procedure words: read as such, where they stand."""
    return frozenset(phrases((*FRAMES, *OPENINGS, *TAGS)))
