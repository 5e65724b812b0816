"""Thanks, endearments, what a thing is wanted for, and who calls: patterns of whole clauses that are left out.

`stories.py` says what such a pattern must not hold; `<name>` stands for a class of either module.
"""

COURTEOUS_CLASSES: dict[str, str] = {
    "vocative": "dear|love|darling|sweetheart|sweetie|honey|pet|duck|mate|pal|buddy|friend|my dear|my love|my friend|"
    "my lovely|my darling|old chap|old boy|old friend|sir|madam|boss|chief|guys|folks|everyone|team|bud|lads|all",
    "much": "much|kindly|awfully|a lot|lots|loads|heaps|a bunch|a ton|tons|a million|a heap|indeed|again|muchly|"
    "sincerely|most kindly|from the bottom of my heart",
    "forhelp": "in advance|for your help|for helping|for helping me|for that|for this|for your trouble|for everything|"
    "for your time|for all you do|for your kindness|for your service",
    "kindness": "kind|good|sweet|nice|helpful|lovely|decent|thoughtful|generous|dear|clever",
    "lovely": "good|clever|dear|lovely|nice|sweet|brave|great|fine|lovable|precious|wonderful|splendid|excellent",
    "poorly": "young|gentle|kind|"
    "poor|dear|sweet|little|good|clever|brave|faithful|old|wee|hard working|silly|lazy|precious|trusty",
    "darling": "thing|dear|soul|darling|mite|creature|lamb|love|chap|lad|lass|boy|girl|pup|pet|fellow|mutt|beastie|"
    "sausage|sweetheart|angel|sport|champ|treasure|star|helper",
    "beloved": "dear|darling|love|lamb|pet|sport|champ|treasure|star|angel|sweetheart|gem|honey",
    "worker": "dog|doggy|doggie|robot|drone|rover|humanoid|quadruped|machine|bot|robots",
    "weary": "tired|exhausted|worn out|sleepy|hungry|thirsty|bored|lonely|weary|knackered|done in|pooped|tired out|"
    "fed up|shattered",
    "praised": "a treasure|a pet|a sweetheart|a marvel|a wonder|a champ|a legend|ace|too good|amazing|marvellous|"
    "a good sort|a dear soul|a life saver|a real help|a great help|a big help|such a help|a sport|a good sport|"
    "a good egg|a gent|a gentleman|awesome|fantastic|a hero",
    "drink": "drink|water|drop of water|sip|sip of water|glass of water|drink of water|something to drink|"
    "cold drink|nice drink|cool drink|drop to drink|cup of water|fresh water|drinking water|refreshment",
    "using": "play with|look at|have a look at|see|drink|drink from|use|show|touch|feel|have a drink from|drink out of|"
    "have fun with|have a go with|take a look at|build with|stack|show off|show my friends|take a sip from|work with",
    "office": "control|command|ops|operations|headquarters|hq|central|reception|desk|lab|laboratory|stage|backstage|"
    "ward|kitchen|theatre|theater|pharmacy|warehouse|workshop|studio|office|gate|tower|site|farm|camp|lodge|hotel|"
    "clinic|hospital|surgery|school|classroom|library|museum|gallery|bar|garage|hangar|depot|yard|rescue|patrol|"
    "dispatch|dispatcher|security|maintenance|logistics|stores|nurse|doctor|medic|foreman|supervisor|manager|director|"
    "teacher|team leader|team lead|lead|boss|captain|lifeguard|coastguard|ranger|harbour|porter|housekeeping|concierge|"
    "admin|bridge|deck|galley|canteen|cafe|shop|floor|lobby|matron|caretaker|warden|base|home|conductor|props|"
    "wardrobe|lighting|sound|front of house|production|centre|center|station|post|room|engineer|technician|trainer|"
    "coach|instructor|curator|librarian|chef|steward|marshal|umpire|referee|quarterdeck|switchboard|guard|guards",
    "of": "front|help|nurse|nurses|nursing|info|information|site|beach|field|ground|air|mission|incident|rescue|range|"
    "event|stage|floor|school|camp|farm|forest|park|mountain|coast|harbour|port|fire|police|medical|first aid|duty|"
    "shift|night|day|control|command|production|warehouse|kitchen|lab|security|festival|race|course|valley|lodge|"
    "ranger|lookout|watch|radio|dispatch|operations|ski|hill|lake|river|island|estate|vineyard|quarry|mine|main|box|"
    "operating|engine|server|staff|common|waiting|treatment|sick|head|chief|senior|ops|house|shop|crew|team|"
    "stock|print|test|clean|green|press|show|tour|museum|gallery|hotel|hospital|clinic|ward|base",
    "number": "[0-9]{1,2}|one|two|three|four|five|six|seven|eight|nine|ten|actual|alpha|bravo|charlie|delta|echo|"
    "foxtrot|a|b|c",
    "everybody": "crew|team|robots|everyone|everybody|all|all units|all robots|units|the crew|the team|the robots|"
    "robot team|robot crew|air team|ground team|all stations|both robots|both",
}

THANKS: tuple[str, ...] = (
    "(?:and |so |well )?(?:thanks|thank you|thank ye|thx|ta|cheers|many thanks|thanking you|much thanks|big thanks|"
    "a thousand thanks)(?: ever| ever so| so| very| so very)*(?: <much>)?(?: <forhelp>)?(?: <vocative>)?",
    "(?:and )?(?:much|most) (?:obliged|appreciated)(?: to you| indeed)?(?: <vocative>)?",
    "(?:i'd|i would|we'd|we would|i'll|i will|i'm|i am|we are|we're|i'd be|i'll be|we'd be) (?:be )?"
    "(?:ever |so |very |most |really |eternally |truly |much |forever |deeply )*(?:grateful|obliged|thankful|indebted)"
    "(?: to you| for that| for it| for your help| indeed)*(?: <vocative>)?",
    "(?:i|we|i'd|we'd|i would|we would)(?: really| very much| do| much| so| greatly)* appreciate (?:it|that|this)"
    "(?: very much| a lot| so much| greatly| no end)?(?: <vocative>)?",
    "(?:i|we|i'd|i'll|we'd|i would|i will) owe you (?:one|big time|a favour|a favor|a drink|a treat)",
    "(?:that's|that is|that'd be|that would be|how|you're|you are|that was|it's|it is|you've been|you are being) "
    "(?:so |very |ever |ever so |most |too |really |awfully |terribly |just |always |such )*<kindness>(?: of you)?"
    "(?: <vocative>)?",
    "(?:you're|you are|you is) (?:really |truly |such |always |just |all )*(?:<praise>|<praised>|a <lovely> <darling>|"
    "a <lovely> <worker>)(?: <vocative>)?",
    "(?:that's|there's|what) (?:a|my|the) (?:<lovely> )+(?:<darling>|<worker>|man|one|friend)",
    "(?:that's|there's) (?:a|my) <beloved>",
    "you (?:<poorly> )+<darling>",
    "(?:good|clever|brave) (?:boy|girl|lad|lass)",
    "you (?:absolute |little |clever |real )?(?:star|beauty|legend|angel|champ|hero|gem|darling|dear|treasure)",
    "(?:oh )?(?:god |lord |heaven )?bless (?:you|him|her|it|them|(?:your|its|his|her|their) (?:little |old |cotton |"
    "dear |metal )*(?:heart|hearts|soul|socks|legs|paws|circuits|cottons))",
    "(?:it|he|she|you|they|it's|you're|you are|it is) (?:must be |looks |look |seems |seem |sounds )"
    "(?:so |very |a bit |rather |really |quite |awfully |terribly |ever so )*<weary>(?: by now| now| already| too)?"
    "(?: poor thing| the poor thing| bless it)?",
    "(?:do |please |now )?be (?:a|an|my) (?:<lovely> )*(?:<darling>|<beloved>|<worker>|friend|help|sport)",
    "(?:pretty please|please please|please(?= with))(?: please)*"
    "(?: with (?:sugar|a cherry|cherries|knobs|bells) on(?: it| top| the top)?)?",
    "(?:off|on) you (?:go|pop|trot)(?: then| now)?|chop chop|there you go|there we go|that's the (?:way|ticket|spirit)",
    "(?:here|come on|go on) (?:boy|girl|doggy|doggie)(?: here boy)?",
    "(?:come on|go on|attaboy|attagirl|giddy up|hop to it|right you are)(?: then| now)?"
    "(?: boy| girl| lad| old boy| old girl| love| dear| mate| pal| buddy| now)?",
    "(?:and )?(?:that's|that is|that'll be|that will be) (?:it|all|everything|the lot)(?: i need| i want| i ask|"
    " we need|"
    " i'm asking| for now| for today| from me| really| thanks| please| then| folks)*",
    "nice one|good stuff|lovely stuff|smashing|brilliant|lovely|wonderful|great stuff|marvellous|super|splendid|"
    "excellent|champion|good on you|good for you|fantastic|awesome|lovely jubbly|ta ra|cheerio|all the best|"
    "have a nice day|have a good day|have a good one|bye|bye bye|goodbye|good night|good day|greetings",
)
"""Thanks and endearments."""

ENDEARED: tuple[str, ...] = ("(?:the )?(?:<poorly> )+<darling>",)
"""The same, in a clause of its own, in a crew that knows nobody of that name."""

WANTED_FOR: tuple[str, ...] = (
    "(?:because |cause |so |as )?(?:i|we|i'd|we'd|i would|i'm|we're)(?: just| really| only| so| do)* "
    "(?:want to|wanna|like to|love to|need to|going to|gonna|dying to|wish to|fancy|can't wait to) <using> "
    "(?:it|that|this|them|some|from it|with it)(?: please| so much| a bit| now| too| again| so badly| for a bit)*",
    "(?:so|so that) (?:i|we) (?:can|may|could|might|am able to) <using> (?:it|that|this|them|some)"
    "(?: please| a bit| now| too| again| for a bit)*",
    "(?:i'm|i am|we're|we are|i've been) (?:<very> |absolutely |simply |just |all )*(?:dying|gasping|longing|desperate|"
    "parched|thirsty|craving|crying out|in need|in want|in dire need|aching|ready)(?: for| of)? (?:a |an |some |my )*"
    "<drink>(?: now| here| please| today)*",
    "(?:i'd|i would|i could|we could|i really|i|we|i do|i'll|we'd) (?:really |so |just |badly |do )*(?:love|like|fancy|"
    "murder|do with|could use|kill for|go for|need|want|die for|enjoy|be glad of) (?:(?:a|an|some|my|a little|a wee) )?"
    "(?:<drink>)(?: now| here| please| today| badly| right now)*",
    "(?:my (?:throat|mouth) is|i'm|i am) (?:so |very |all |terribly |ever so )*(?:dry|parched|bone dry)",
)
"""What a thing is wanted for. Another clause names the thing and asks for it, or nothing is asked for."""

CALLING: tuple[str, ...] = (
    "this is (?:the )?(?:<of> )?<office>(?: <number>)?(?: speaking| calling| here)?",
    "(?:<of> )?<office>(?: <number>)? (?:speaking|calling|here)",
    "this is [a-z]+ (?:speaking|calling)(?: from (?:the )?(?:<of> )?<office>)?",
)
"""Who speaks, in a clause of its own that names nothing of the crew."""

CALLING_ALL: tuple[str, ...] = (
    "(?:<of> )?<office>(?: <number>)? (?:to|for|calling) (?:<everybody>)",
    "(?:<everybody>)(?: this is| from) (?:the )?(?:<of> )?<office>(?: <number>)?",
)
"""Who speaks, and that everybody is meant."""

CALLING_ONE: tuple[str, ...] = ("(?:this is )?(?:the )?(?:<of> )?<office>(?: <number>)? (?:to|calling)",)
"""Who speaks, in front of the robot that is called."""
CALLED_FROM: tuple[str, ...] = ("from (?:the )?(?:<of> )?<office>(?: <number>)?",)
"""The same behind it."""
