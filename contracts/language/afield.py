"""Plainer words for what is said to a crew that searches and drives: templates, no logic; `patterns.py` reads them.

No plainer wording adds a name, a place, a figure or a negation, nor takes one away.
"""

import re

_GOING = (
    "(close on|close in on|home in on|converge on|rendezvous with|link up with|meet|meet up with|join|join up with|"
    "reach|approach|make for|head for|respond to|attend to|move in on|move up on|close with|advance on|advance to|"
    "proceed towards|make contact with|go over to|go and meet|go meet|go find|pull up at|pull up to|drive up beside)"
)
_GOES = (
    "(closes on|closes in on|homes in on|converges on|meets|joins|reaches|approaches|makes for|heads for|responds to|"
    "attends to|moves in on|advances on|advances to)"
)
_STOP = "(a stop|a halt|a standstill|a full stop|a complete stop|a complete halt|rest|a dead stop)"
_WAY = "(the way|its way|a way|his way|her way|their way|your way|way)"
_SITE = (
    "(grounds|property|estate|premises|terrain|compound|plot|place|site|map|territory|operational area|operations area|"
    "search area|search zone|land|venue|facility|field|area|whole area|whole site|whole field)"
)
_WHOLE = "(whole|entire|complete|full|total)"
_GROUND = (
    "(place|grounds|property|estate|premises|terrain|compound|map|territory|plot|site|land|venue|facility|campus|"
    "search area|search zone|operational area|operations area)"
)
_HALVES = "(half|part|side|section|portion)"

AFIELD: tuple[tuple[str, str], ...] = (
    (
        f"{{driver}} (|to |should |must |shall |will |can |could |then |and then ){_GOING} {{person}}",
        "{driver} should go to {person}",
    ),
    (f"{{driver}} (|then |and then ){_GOES} {{person}}", "{driver} goes to {person}"),
    (f"(have|let|get|make|tell|ask) {{driver}} (|to ){_GOING} {{person}}", "send {driver} to {person}"),
    (f"(bring|get|take) {{driver}} to {_STOP}", "stop {driver}"),
    (f"{{driver}} (|to |should |must |shall |will )(come|comes) to {_STOP}", "stop {driver}"),
    (f"(let|have|make|get|allow) {{driver}} (|to )come to {_STOP}", "stop {driver}"),
    ("^ {driver} (halted|stopped|at a stop|at a halt) $", "stop {driver}"),
    ("^ {flier} (landed|grounded) $", "land {flier}"),
    ("^ {flier} (|down |back down |back )(on|to|onto) the ground $", "land {flier}"),
    (
        "until (it|he|she|you|they|{flier}) (finds|find|spots|spot|sees|see|locates|locate|has found|have found) "
        "{person}",
        "and find {person}",
    ),
    ("and (park|park it|park up|stand by|hold position|hold|stay|wait|remain) (there|on the spot|at that point) $", ""),
    (
        f"{{driver}} (makes|make|takes|take|finds|find|to make|to find|should make|must make) {_WAY} (to|towards)",
        "{driver} to",
    ),
    (
        "(set|give|assign) {driver} (a |the |its |a new |the new |as |as its |)(goal|destination|waypoint|target|"
        "target "
        "position|goal position) (at|of|to|on|:|,|is|) (|at )",
        "send {driver} to",
    ),
    ("(|, )and (let|have|make) it (drive|go|move|travel) there $$", ""),
    (
        "^ {flier} (goes|flies|climbs|rises|to go|to climb|to rise|to fly) (up|) (|, |to |, to ){height}",
        "launch {flier} to {height}",
    ),
    ("(fly|flies|flying) (|it |out )(in|through|across|above|all over|throughout) {zone}", "fly over {zone}"),
    ("(fly|flies) {flier} (over|across|through) {zone}", "have {flier} fly over {zone}"),
    ("(fly|flies) {flier} at {height} (over|across|through) {zone}", "have {flier} fly over {zone} at {height}"),
    (
        "(run|do|make|start|conduct|perform|launch|carry out|organise|organize|initiate|commence|begin|mount|fly|"
        "execute|undertake) {flier} (search|sweep|scan|survey|recce|reconnaissance|search flight|search mission) "
        "(of|over|in|across)",
        "have {flier} search",
    ),
    ("for (find|search|look for|locate)", "to find"),
    (
        "(looks|searches|combs|goes all) (through|over|all over|across|around|round|about|all around|all round) {zone}",
        "searches {zone}",
    ),
    (
        "(look|have a look|take a look|a look|looking|check) (round|around|about|all over|all around|all round) {zone}",
        "search {zone}",
    ),
    (f"{{zone}} of (the|our|this|that|these|your) {_SITE}", "{zone}"),
    (f"(the |)(whole|entire) of (the |our |){_GROUND}", "the whole area"),
    (f"(the |our |this |that |){_WHOLE} {_GROUND}", "the whole area"),
    (f"(all|all over|all of|over all|in all) (the |our |){_GROUND}", "the whole area"),
    (f"the {_HALVES} (of|in|to) (the |){{zone}}", "{zone}"),
    ("would you mind (having|getting)", "please have"),
    (
        "(we've got|we have got|we have|i've got|i have) {person} , (he's|she's|he is|she is|they're|they are) (lost|"
        "missing)",
        "{person} is missing ,",
    ),
    ("and (after|afterwards|after that) ,", "and then"),
)
"""What is said, and what it is read as."""


def afield_words() -> frozenset[str]:
    """Every word of these wordings: none of them is a slip."""
    return frozenset(w for said, _ in AFIELD for w in re.findall(r"[a-z']+", re.sub(r"\{\w+\}", "", said)))
