"""More wordings with names in them: walking robots, places that are to have something, loads on a back."""

_OVER = "(|on |over |along |off |down |up |across |round |around |out |back |straight |home |on over |over there )"
_STROLL = (
    "(pop|nip|wander|stroll|dash|hop|skip|potter|mosey|toddle|scuttle|scamper|advance|march|saunter|shuffle|step|jog|"
    "gallop|roll|patter|prance|bound|pad|waddle|plod|scoot|zip|get itself|betake itself|take itself|make a move|"
    "make its way|find its way|get going|get moving|hurry|bounce|canter|strut|hike|hotfoot it|leg it)"
)
_DIRECT = "(direct|guide|point|lead|escort|urge|route|shoo|steer|usher|coax|command|wave)"
_SURE = (
    "(ensure|ensure that|make certain|make certain that|see that|see to it that|see|make sure|make sure that|be sure|"
    "be sure that|take care that)"
)
_GETS = "(gets|goes|proceeds|moves|comes|walks|drives|heads|ends up|arrives|returns|travels|runs|is sent|is brought)"
_THEN = "(, |and |; |. |then |, then |and then |, and )"
_RECEIVES = (
    "(is to receive|should receive|shall get|is to get|must get|must have|should have|is due|is owed|is to have|"
    "shall have|shall receive|has been promised|was promised|is expecting|expects|will be needing|is waiting on|"
    "should be given|must be given|is to be given|has put in a request for|has a need for|has need of)"
)
_VERBS = (
    "wave",
    "pick up",
    "hold",
    "go",
    "walk",
    "take",
    "bring",
    "carry",
    "lift",
    "grab",
    "put",
    "come",
    "move",
    "fetch",
)

WALKS: tuple[tuple[str, str], ...] = (
    (f"{{robot}} (please |now |just |to |){_STROLL} {_OVER} (to|into|in|at) {{place}}", "{robot} go to {place}"),
    (f"^ {_STROLL} {_OVER} (to|into) {{place}}", "go to {place}"),
    (f"^ {_DIRECT} {{robot}} {_OVER} (to|into) {{place}}", "send {robot} to {place}"),
    (f"^ {_SURE} {{robot}} {_GETS} {_OVER} (to|in|at|into)", "send {robot} to"),
    (f"^ (get|take|bring|move|drag|haul) (yourself|itself|yourselves) {_OVER} (to|into|in)", "go to"),
    ("(rtb|rtb to|return to base|rtb at) {place}", "go to {place}"),
    (
        "(go|come|walk) (and |)(sleep|rest|lie down|nap|wait|sit|stand|stay|sit down|have a rest|have a nap) (in|"
        "at|on|by)",
        "go to",
    ),
    ("{object} (reaches|arrives at|arrives in|makes it to|gets into|reach)", "{object} gets to"),
    ("^ (let|have) {place} have {object}", "take {object} to {place}"),
    ("^ (give|get|lend|fetch) {place} {object}", "take {object} to {place}"),
    ("^ (supply|provide|furnish|equip|serve|stock|resupply|present) {place} with {object}", "take {object} to {place}"),
    ("{place} " + _RECEIVES + " {object}", "{place} needs {object}"),
    (
        f"(load|put|place|set) {{object}} (up |)(on|onto) {{carrier}} {_THEN} {{carrier}} (|go |goes |walk |"
        f"off )(to|into) {{place}}",
        "load {object} on {carrier} then {carrier} go to {place}",
    ),
    (
        f"^ {{object}} (on|onto) {{carrier}} {_THEN} {{carrier}} (|go |goes |walk |off )(to|into) {{place}}",
        "load {object} on {carrier} then {carrier} go to {place}",
    ),
    (
        f"^ {{object}} (on|onto) {{carrier}} {_THEN} (off|away|over|then|go|it goes|on) (to|into) {{place}}",
        "load {object} on {carrier} and take it to {place}",
    ),
    (
        "^ (by|with|via|using) {carrier} (, |: |)(please |){object} (to|into|for) {place}",
        "{carrier} carry {object} to {place}",
    ),
    ("^^ (to|into|for) {place} (, |: |- |)(please |){object} (please |) $$", "carry {object} to {place}"),
    ("^^ (to|into) {place} with {object}", "carry {object} to {place}"),
    ("^ (away|off|over|out|on|along) with {object} (to|into) {place}", "carry {object} to {place}"),
    (
        "with {object} (on board|aboard|on top|in tow|loaded|on it|on the tray|in the tray|on the back|in its tray|"
        "on its tray|in its basket|strapped on|on him|on her)",
        "with {object}",
    ),
    (
        "{object} (can|may|could|should|shall|has to|needs to|is to|ought to) go (back |down |over |)(on|onto) {place}",
        "put {object} on {place}",
    ),
    ("{object} (may|might) be", "{object} should be"),
    ("^ let {object} (be|sit|stand|lie|rest) (on|onto) {place}", "put {object} on {place}"),
    (
        "^ (get|put|set|place|lay) {object} (up |over |back |across |down |up there |)(on|onto|on top of) {place}",
        "put {object} on {place}",
    ),
    *(
        (
            f"(i'd love|i want|i'd like|i would like|we want|we'd like|we'd love|i would love) to see {{robot}} {verb}",
            f"have {{robot}} {verb}",
        )
        for verb in _VERBS
    ),
    ("^ (any|is there any|is there a) (chance|hope|possibility) (of|for) {object}", "could i have {object}"),
    (
        "^ is there (any|a) (way|chance|possibility) (that |)(i|we) (could|can|might) (have|get) {object}",
        "could i have {object}",
    ),
    *((f"{verb} {{it}} (over|across|here|over here) $", f"{verb} {{it}} to me") for verb in ("pass", "give", "hand")),
    ("^ (|here's |here is )what (i|we) (want|need|would like) (is |)(: |, )", "i want"),
    (
        "(request|requesting|commence|begin|initiate|perform|do|start|execute|carry out) (|a |the )(handover|hand over|"
        "handing over) (of |){object}",
        "hand over {object}",
    ),
    ("^ (handover|handing over|hand over) of {object}", "hand over {object}"),
    ("handover {object}", "hand over {object}"),
    ("to {operator} (position|location|side|station|spot|seat|place)", "to {operator}"),
    (
        "to me (|here |over here |out )(in|at|on|by) (the|my|our) (garden|kitchen|hall|hallway|lounge|"
        "living room|bedroom|"
        "bathroom|office|study|corridor|workshop|patio|terrace|porch|balcony|yard|conservatory|other end|far end|back|"
        "corner|next room|dining room|sitting room|front|reading corner)",
        "to me",
    ),
    ("(come over|come along|come round|come by|come back|come) with {object} $", "come here with {object}"),
)
"""What is said, and what it is read as; the first that fits."""
