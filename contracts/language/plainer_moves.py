"""More wordings with names in them: how things and robots are moved, forms that are filled in, gestures to people."""

_BODY = "(hand|hands|gripper|grip|claw|fist|fingers|arms)"
_AT = "(at|in|by|near|on|inside|beside|next to)"
_TO = "(to|into|in|at|over to|onto|on)"
_CARRIED = "(object|item|payload|cargo|load|thing|pick up|pickup|collect|package|what)"
_GOAL = "(drop off|dropoff|destination|deliver to|goal|target|drop|to|where|deliver|delivery|drop point)"
_BY = "(carrier|robot|unit|vehicle|by|transport|courier|with|who|using|via|executor|assigned)"
_MARK = "(: |- |= |, |)"
_SEEN = (
    "(for me to see|for us to see|for everyone to see|for everybody to see|for all to see|for them to see|"
    "for the camera|so i can see it|so that i can see it|so we can see it|so everyone can see it|"
    "so everybody can see it|so that everyone can see it|so they can see it|where i can see it|so i can see|"
    "so we can all see it|so everyone can see|for a photo|for the photo|for a picture)"
)
_HURLED = (
    "(whizz|whisk|zip|nip|rush|hurry|speed|wheel|scoot|dash|trolley|schlepp|hump|truck|bundle|shoot|pass|nudge|rush|"
    "get moving|hoof|trot|trundle|drive|walk|run|bus|port|hand carry|forward|advance|conduct|escort|guide)"
)
_LAID = (
    "(swap|slide|hoist|swing|plant|perch|dump|stand|drop|settle|pop|plonk|sit|rest|lower|arrange|install|"
    "position|store)"
)

MOVES: tuple[tuple[str, str], ...] = (
    ("(off|away|back|over) (to|into) {place} with {it}", "send {it} to {place}"),
    (
        "{robot} (has|deserves|has well) (earned|done|worked|had|) (its rest|a rest|enough|hard|its keep|"
        "a break|his rest|"
        "hard enough|a good day's work|plenty|its break|her rest)(| today| now| for today| for one day) $",
        "{robot}",
    ),
    ("{object} (thing|thingy|thingie)", "{object}"),
    (
        "^ (shift|transfer|relocate|return|restore|switch|swap|slide|get back|bring back|take back) {object} "
        "(over |back |across |along |through |down |up |)to {place}",
        "move {object} to {place}",
    ),
    (
        "^ (clear|shift|switch|slide|take|get|move|swap|remove|lift) {object} (off|from|off of) {place} "
        "(and put it |and place it |and set it |and |)(onto|on to|on|to|over to|over onto|across to) {place}",
        "move {object} from {place} to {place}",
    ),
    (
        f"^ {_HURLED} {{object}} (over |back |across |along |through |down |up |off |out |straight |)(to|"
        f"into) {{place}}",
        "carry {object} to {place}",
    ),
    (
        f"^ {_LAID} {{object}} (down |over |back |across |)(on|onto|on to|on top of) {{place}}",
        "put {object} on {place}",
    ),
    (
        "{object} (belongs|should be|ought to be|has its place|is meant to go|is supposed to go|is to go|wants to go) "
        "(in|at|to|over in) {place} (, |so |and |. )(so |please |)(put|take|bring|get|move|carry) it there",
        "take {object} to {place}",
    ),
    (
        "{object} (belongs|has its place|is meant to go|is supposed to go|is destined|is bound|is headed) "
        "(in|at|to|for|over in) {place}",
        "{object} goes to {place}",
    ),
    ("{object} (finds|makes|find|make) its way (to|into)", "{object} gets to"),
    (
        "{robot} (home|back|over|along|down|up|round|around|across|through|off|out|straight|on over) (to|into) {place}",
        "{robot} to {place}",
    ),
    (
        "{object} (over|along|down|up|round|around|across|through|off|out|straight|in|on over|away|forth) (to|"
        "into) {place}",
        "{object} to {place}",
    ),
    ("(, |and |; |. |)(use|take|using|choose) {robot} (|for that |for it |for this ) $$", "with {robot}"),
    (f"{_CARRIED} {_MARK} {{object}} (, |. |; |){_GOAL} {_MARK} {{place}}", "carry {object} to {place}"),
    (
        f"^ (destination|goal|drop off|dropoff|to) (: |- |= ){{place}} (, |. |; |){_CARRIED} {_MARK} {{object}}",
        "carry {object} to {place}",
    ),
    (
        "{object} (, |; |. )(destination|goal|drop off point|target|deliver to) (: |- |= |is |){place}",
        "{object} to {place}",
    ),
    (f"(, |. |; ){_BY} (: |- |= |){{robot}} $", "with {robot}"),
    (
        "^ (effect|make|carry out|execute|perform|arrange|provide|complete|organise|organize|initiate) (|a |the )"
        "(delivery|transport|conveyance|transportation) of {object}",
        "deliver {object}",
    ),
    (
        "(give|hand|pass|hand over|pass on|entrust|give over) {object} (over |on |)to {carrier}",
        "load {object} on {carrier}",
    ),
    ("(give|hand|pass) {carrier} {object}", "load {object} on {carrier}"),
    ("(load up|load|pack|fill|charge|saddle) {carrier} (up |)with {object}", "load {object} on {carrier}"),
    ("(on|onto|upon) the back of {carrier}", "on {carrier}"),
    ("with {object} on (its|his|her|their) (back|tray)", "with {object}"),
    ("(put|place|set|load|lay) {object} (up |)(on|onto) (its|his|her|their) back", "load {object} on tray"),
    ("^ (i|we) (ask|request|demand|insist|order|wish|command|desire) that", "i want that"),
    ("^ it is (desired|wished|requested|asked|ordered|decided|planned|intended) that", "i want that"),
    ("^ (is|are) {robot} able to", "please {robot}"),
    ("^ (might|may) {object} be", "could {object} be"),
    ("^ how about {robot} {doing}", "{robot} please {doing}"),
    *(
        (f"^ why not (just |simply |){verb}", verb)
        for verb in ("have", "let", "get", "send", "take", "bring", "put", "carry", "move")
    ),
    ("^ (|it's |it is )(time|about time|high time) for {robot} to", "{robot} please"),
    (
        f"^ (get|have|make|keep|want) {{robot}} (ready|waiting|standing by|in position|positioned|stationed|"
        f"in place|set up|"
        f"standing|sitting|parked|on standby|to wait|wait) {_AT} {{place}}",
        "send {robot} to {place}",
    ),
    (
        "(go|come|walk|run|trot) and (sit|wait|stand|lie|stay|rest|park|lie down|sit down|stand by) (in|at|by|on)",
        "go to",
    ),
    ("(come|go|walk|run) and (see|visit|join|find|meet|help) me", "come to me"),
    ("^ {robot} (, |)(please |)come (, |)(please |now |on |) $$", "{robot} come here"),
    ("^ come (, |on |on , |)(please |now |)(, |){robot} $$", "{robot} come here"),
    ("(plug|hook) {robot} (in|up|back in)", "send {robot} to charging"),
    (
        f"(take|hold|grab|pick up|keep|grasp|carry|get) {{object}} (up |)(in|into|with|between) (its|his|her|"
        f"your|the|one) {_BODY}",
        "hold {object}",
    ),
    ("{object} (and |, )(don't|do not|never) (let go|let it go|let go of it|drop it) $", "{object}"),
    (
        "(get a grip on|get a grip of|take a grip on|get a hold of|keep a grip on|keep hold of|keep a hold of|"
        "have a hold of) {object}",
        "hold {object}",
    ),
    (f"{_SEEN} $", ""),
    ("wave (its|his|her|their|an|one|both|both its|his other) (arm|hand|arms|hands)", "wave"),
    ("(hand|pass|give) (up|across|down|along|round|out) {object}", "hand over {object}"),
    *(
        (f"{verb} me {{object}} (over|across|here|over here|up|round|along) $", f"{verb} me {{object}}")
        for verb in ("hand", "pass", "give", "bring")
    ),
    *(
        (
            f"{wish} to (hold|see|touch|play with|look at|use|drink from|feel|examine|inspect|try|"
            f"have a look at) {{object}} "
            f"(myself |too |please |for a bit |)(, |. |; |, so |so |and ){ask}",
            f"{{object}} , {ask}",
        )
        for wish in ("(i'd like|i want|i would like|i'd love|we want|we'd like|i wish)",)
        for ask in ("could you", "can you", "would you", "will you", "please", "give", "hand", "pass", "bring")
    ),
    (
        "(they're|they are|people are|someone is|somebody is|everyone is|everybody is) (waiting|asking|calling|"
        "hoping|longing) for "
        "{object}",
        "they need {object}",
    ),
    ("^ {giver} (: |, |- )(please |){object} (to|on|onto|- >|= >|at) {place} $$", "{giver} put {object} on {place}"),
    ("^ {carrier} (: |, |- )(please |){object} (to|into|- >|= >) {place} $$", "{carrier} carry {object} to {place}"),
)
"""What is said, and what it is read as; the first that fits."""
