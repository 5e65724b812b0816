"""What people call whoever is to be found, and what they say of them. Data.

A word stands here only if, beside a verb that searches, it can be nobody but the one person who is looked for.
"""

from collections.abc import Iterator


def _listed(text: str) -> tuple[str, ...]:
    return tuple(text.split())


FAMILY = _listed(
    "man woman boy girl guy lady gentleman child kid son daughter brother sister mother father mum mom mummy mommy dad "
    "daddy husband wife grandson granddaughter grandmother grandfather grandma grandpa granny grandad granddad uncle "
    "aunt auntie cousin nephew niece fellow fella chap bloke nan nana gran gramps grandparent grandchild stepson "
    "stepdaughter stepfather stepmother fiance fiancee girlfriend boyfriend spouse relative sibling twin"
)
CIVIL = _listed(
    "climber walker runner jogger camper friend colleague neighbour neighbor coworker classmate schoolmate teammate "
    "flatmate roommate skier snowboarder swimmer surfer cyclist rider horsewoman horseman rambler backpacker trekker "
    "mountaineer orienteer wanderer stroller birdwatcher forager angler fisherman boater kayaker canoeist sailor diver "
    "paraglider parachutist skydiver sightseer tourist holidaymaker vacationer traveller traveler visitor guest client "
    "customer resident tenant lodger inmate pensioner senior retiree pupil student schoolboy schoolgirl schoolchild "
    "teenager teen toddler youngster youth adolescent infant lad lass laddie lassie farmer farmhand farmworker "
    "shepherd picker gardener worker workman labourer laborer employee apprentice trainee intern miner logger "
    "lumberjack woodcutter builder roofer electrician plumber mechanic engineer technician surveyor geologist botanist "
    "archaeologist scientist researcher photographer journalist postman postwoman mailman courierman driver motorist "
    "passenger motorcyclist pedestrian passerby bystander commuter festivalgoer spectator participant competitor "
    "contestant racer golfer player athlete hunter beekeeper vet stockman cowboy drover contractor volunteer soul "
    "stranger individual parishioner member soldier corporal private sapper patroller trooper gunner infantryman "
    "rifleman paratrooper serviceman servicewoman veteran bandsman actor actress extra stagehand stuntman "
    "cameraman dancer singer musician roadie attendee delegate exhibitor tripper evacuee refugee"
)
"""Whoever may be lost."""
HELPERS = _listed(
    "marshal steward warden ranger guide scout cub lifeguard guard officer policeman policewoman constable soldier "
    "recruit cadet airman firefighter fireman paramedic medic nurse doctor carer caretaker teacher leader instructor "
    "supervisor manager foreman captain pilot observer searcher sergeant lieutenant major operator dispatcher "
    "coordinator boss "
    "chief priest guardian crewman crewmember adult male female minor party subject individual baby pal mate buddy "
    "elder one sapper trooper gunner private corporal sergeant lieutenant captain major colonel rifleman marine seaman "
    "patroller lifeboatman waiter waitress chef cook baker butcher bartender barista receptionist cleaner housekeeper "
    "porter bellboy concierge librarian clerk secretary accountant editor reporter presenter actor actress cameraman "
    "stuntman dancer singer musician drummer producer director rigger gaffer painter carpenter joiner welder "
    "bricklayer glazier plasterer scaffolder trucker docker deckhand bosun stewardess conductor inspector detective "
    "cop prisoner suspect fugitive refugee migrant evacuee caravanner hitchhiker pilgrim monk nun priest vicar pastor "
    "rabbi bishop janitor lecturer professor jockey loader packer sorter user patient usher bouncer vendor seller "
    "shopper shopkeeper landlord biker triathlete marathoner lookout sentry handler trainer coach referee umpire groom "
    "gamekeeper groundsman zookeeper hairdresser barber tailor judge lawyer notary mayor governor ambassador novice "
    "freshman sophomore undergraduate scholar babysitter nanny au-pair courier messenger delegate attendee exhibitor "
    "organiser organizer roadie stagehand extra tattooist artist sculptor writer poet blogger streamer"
)
SUFFIXES: tuple[str, ...] = ("man", "woman", "boy", "girl", "person")
"""Ends of other words for people, behind a word such as `missing`."""
NO_PEOPLE = frozenset(_listed("snowman talisman ottoman caiman walkman tallboy highboy lowboy gameboy bogeyman"))
"""Words with such an end that are, or may be, things."""
"""Whoever may be lost, but may as well be somebody else or something else: only with a word such as `missing`."""
DEAR: tuple[str, ...] = ("poor thing", "poor devil", "poor dear", "poor wretch", "little one", "loved one")
"""What only a feeling makes a person."""
LOST: tuple[str, ...] = ("missing", "lost", "overdue", "injured", "hurt", "wounded", "stranded", "trapped", "fallen")
"""Such words."""
COMPOUNDS: dict[str, tuple[str, ...]] = {
    "driver": ("delivery", "truck", "lorry", "bus", "taxi", "van", "tractor", "car", "cab"),
    "walker": ("dog", "hill", "fell", "mountain"), "runner": ("trail", "fell", "race", "marathon"),
    "biker": ("mountain",), "climber": ("rock", "mountain", "ice"), "worker": (
        "farm", "field", "forestry", "maintenance", "construction", "site", "warehouse", "seasonal", "care", "road",
    ),
    "rider": ("horse", "motorbike", "bike"), "picker": ("mushroom", "fruit", "berry", "apple", "grape"),
    "student": ("exchange", "university"), "skier": ("cross country",), "swimmer": ("wild",),
    "member": ("staff", "crew", "team", "family", "club", "group"), "guest": ("hotel", "wedding", "house"),
    "resident": ("care home", "nursing home"), "watcher": ("bird",), "engineer": ("site", "field"),
    "hand": ("farm", "ranch", "stage"), "goer": ("festival", "party"),
}  # fmt: skip
"""Nouns in front of one of these, which add nothing."""
PLURALS: tuple[str, ...] = ("people", "children", "kids", "men", "women", "friends", "gentlemen", "ladies", "families")

DESCRIBING: frozenset[str] = frozenset((
    "elderly", "aged", "frail", "confused", "disoriented", "disorientated", "distressed", "vulnerable", "young",
    "unaccounted", "middle-aged", "teenage", "adult", "male", "female", "deaf", "blind", "sick", "ill", "unwell",
    "unconscious", "exhausted", "diabetic", "pregnant", "disabled", "senile", "demented", "autistic", "poorly",
    "bewildered", "wandering", "unfortunate", "solo", "lone", "beloved", "wayward", "runaway", "suspected",
))  # fmt: skip
"""Adjectives of a person that a search cannot heed and need not."""

_N = (
    "(?:[0-9]{1,3}|(?:twenty|thirty|forty|fifty|sixty|seventy|eighty|ninety)(?: (?:one|two|three|four|five|six|seven|"
    "eight|nine))?|two|three|four|five|six|seven|eight|nine|ten|eleven|twelve|thirteen|fourteen|fifteen|sixteen|"
    "seventeen|eighteen|nineteen)"
)
_AGE = (
    f"(?:(?:age|aged|of|about|around) (?:about |around )?{_N}(?: years)?|"
    f"{_N} (?:years?|yrs?|months?) old|{_N} (?:years|yrs) of age|{_N} yo)"
)
_DECADES = "(?:teens|twenties|thirties|forties|fifties|sixties|seventies|eighties|nineties)"
_WHOSE = "(?:his|her|their)"
_SEX = "(?:(?:a |an )?(?:(?:white|elderly|young|adult|middle aged|frail|old) )*(?:male|female|adult))"
_AGENT = (
    "(?:(?:the|a|an|his|her|their|our|my) )?(?:(?:hut|park|site|duty|night|local|race|school|mountain|shift|front|"
    "head|group|tour|care|youth|security) )?(?:warden|ranger|police|staff|wife|husband|mother|father|parents|family|"
    "friends|friend|son|daughter|brother|sister|colleagues|colleague|neighbours|neighbour|neighbor|neighbors|school|"
    "caller|witness|witnesses|manager|guide|teacher|coach|farmer|marshal|steward|stewards|guard|dispatch|group|"
    "carer|carers|nurse|desk|office|partner|relatives|relative|owner|keeper|leader|team|companions|club|coastguard|"
    "lifeguard|reception|receptionist|organiser|organisers|supervisor|foreman|home|public)"
)
_COLOUR = (
    "(?:(?:bright |dark |light |pale )?(?:red|blue|green|yellow|orange|white|black|grey|gray|brown|pink|purple|beige|"
    "navy|hi vis|high vis|khaki|camouflage|checked|striped|denim|fluorescent))"
)
_CLOTHES = (
    "(?:jacket|coat|shirt|t shirt|jumper|sweater|hoodie|hat|cap|trousers|jeans|shorts|dress|skirt|anorak|vest|top|"
    "tunic|uniform|overalls|raincoat|scarf|clothing|clothes|cardigan|rucksack|backpack|beanie|helmet|boots)"
)
REPORTED = f"(?:reported|as reported|reported as|called in)(?: (?:missing|lost|overdue))?(?: by {_AGENT})?"
YEARS_OLD = rf"{_N} (?:years?|yrs?) old"
TAILS: tuple[str, ...] = (
    "of (?:ours|mine|yours|theirs)",
    f"in {_WHOSE} (?:early |mid |late )?{_DECADES}",
    f"(?:[,(-] )?{_AGE}",
    f"[,(-] {_SEX}(?: in {_WHOSE} (?:early |mid |late )?{_DECADES})?(?: (?:, )?(?:(?:about |around |roughly |"
    f"approximately |approx |nearly |some )?{_N}|{_AGE}))?",
    f"[,(-] {_N} (?:, )?(?:male|female)",
    f"(?:[,(-] )?(?:is )?{REPORTED}",
    "[,(-] (?:mr|mrs|ms|miss|dr)(?: \\.)? [a-z]+",
    f"[,(-] (?:wearing |in |dressed in |last seen wearing |last seen in )?(?:a |an )?{_COLOUR} {_CLOTHES}(?: and "
    "(?:a |an )?"
    f"(?:{_COLOUR} )?{_CLOTHES})?",
    "(?:called|named|by the name of) [a-z]+",
)
"""What may follow a person, one after the other, and goes with them."""


NOUNS: frozenset[str] = frozenset(
    (*FAMILY, *CIVIL, *HELPERS, *COMPOUNDS, *PLURALS, *(said.split()[-1] for said in DEAR))
)
"""The last words of all these names."""


def names_of_people() -> Iterator[str]:
    """What else a person is called, in a crew that looks for `person`: in the singular, as phrases."""
    yield from (*FAMILY, *CIVIL)
    yield from (f"{said} {noun}" for noun, many in COMPOUNDS.items() for said in many)
    yield from DEAR
    yield from (f"{said} {noun}" for noun in HELPERS for said in LOST)


NO_SLIPS: frozenset[str] = frozenset(
    _listed(
        "ops rescue office lodge range ride mine race care manage observe forage retire commute gust plot dive "
        "finish quit "
        "scrub terminate plug camp party surf golf score board trail train plan pilot resident reside wander "
        "stroll travel tour visit hunt farm build research photograph engine mechanism tend tenet inmate lass"
    )
)
"""Words that would be slips of these names, were they not words."""


_MEN = frozenset(
    _listed(
        "man guy gentleman fellow chap bloke boy lad laddie son brother father dad daddy husband grandson grandfather "
        "grandpa grandad granddad gramps uncle nephew stepson stepfather boyfriend fiance schoolboy policeman horseman"
    )
)
_WOMEN = frozenset(
    _listed(
        "woman lady girl lass lassie daughter sister mother mum mom mummy mommy wife granddaughter grandmother grandma "
        "granny nan nana gran aunt auntie niece stepdaughter stepmother girlfriend fiancee schoolgirl policewoman "
        "horsewoman"
    )
)
_YOUNG = frozenset(
    _listed(
        "boy girl child kid toddler infant youngster teenager teen adolescent lad lass laddie lassie schoolboy "
        "schoolgirl "
        "schoolchild pupil baby"
    )
)
_GROWN = frozenset(
    _listed(
        "man woman guy gentleman lady bloke husband wife mother father mum mom mummy mommy dad daddy grandmother "
        "grandfather "
        "grandma grandpa granny grandad granddad gran gramps nan nana uncle aunt auntie pensioner senior retiree"
    )
)
APART: tuple[tuple[frozenset[str], frozenset[str]], ...] = ((_MEN, _WOMEN), (_YOUNG, _GROWN))
"""Nouns of the one kind and of the other are two people."""
BROAD: frozenset[str] = frozenset(
    _listed(
        "man woman boy girl child kid guy lady gentleman fellow chap bloke soul individual youngster lad lass thing"
    )
)
"""Nouns that may say again who was named by another one."""
