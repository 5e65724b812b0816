"""What could bear on a request, hidden in what people say around it: none of it may be passed over in silence."""

REQUESTS = {
    "air_ground": (
        "send the rover to base", "search the north half", "find the hiker and send the rover",
        "control to rover: go to base",
    ),
    "humanoid_quadruped": (
        "take the bottle to room_a", "put the cube on table_b", "send the dog to the charger",
        "stage to crew: red cube to dropoff", "have the block set down on table_a",
        "the dog is needed in room_b, send it over",
    ),
}  # fmt: skip
JOINS = (
    "{c}, {r}", "{c}. {r}", "{r}, {c}", "{r}. {c}", "{c}, so {r}", "{c} so please {r}", "{r} because {c}", "{r} {c}",
    "{c} {r}",
    "{r} and {c}", "{c} but {r}", "{r} - {c}", "{r}, as {c}", "{r} since {c}",
)  # fmt: skip
CONSTRAINTS = (
    "the bridge is closed", "the corridor is blocked", "the road is mined", "the field is flooded",
    "the gate is locked",
    "the floor is wet", "the battery is low", "there is a fire", "there's a hole in the ground",
    "there is somebody in the way",
    "nobody is there yet", "my son is playing out there", "my husband is standing in the way",
    "we have people on the road",
    "we are standing outside", "I am in the way", "I'm right behind it", "I am holding it", "I have it already",
    "it is forbidden", "it is not allowed", "it is too late", "it's too dark", "it is dangerous", "it can wait",
    "it is not urgent",
    "it is no longer needed", "it isn't necessary any more", "it was yesterday", "it is done already", "it's closed",
    "it's raining",
    "I said no", "I don't want that", "I'd rather not", "I would rather do it myself", "I will do it myself",
    "I am not sure",
    "I changed my mind", "I was only joking", "my wife says no", "the doctor forbids it", "the kids said not to",
    "the police say no",
    "we are not allowed to", "you must not", "you may not", "you are not permitted", "you need permission",
    "ask me first",
    "wait for me", "wait for my signal", "until noon", "until it's late", "till I say so", "before it gets dark",
    "before we are tired", "after lunch", "at noon", "at five o'clock", "in an hour", "in ten minutes", "tomorrow",
    "not now",
    "not today", "later today", "if it is late", "if it gets dark", "if I'm tired", "if my back hurts",
    "if that's true", "if it works",
    "if all is well", "if you can hear me", "unless it is urgent", "unless I'm busy", "when it is dark",
    "when I'm ready",
    "when my brother is lost", "once it is dark", "while I'm busy", "as long as it is dark", "only if I say so",
    "only at night",
    "as it gets dark", "provided it's late", "twice", "slowly", "carefully", "quietly", "every hour", "three times",
    "I think", "I guess", "maybe", "perhaps", "or not", "or something", "instead", "no", "never mind",
    "just kidding", "as a test",
    "he said", "she wrote", "it says here", "what if", "not because I'm tired", "not that it's urgent",
    "my hands are full",
    "somebody asked me not to", "I wonder", "don't", "please don't", "without me", "except at night",
    "he doesn't want it", "I'm standing on the track", "we are sitting in its path", "I'm by the fuse box",
    "I'm at the limit", "I can't leave the baby alone",
)  # fmt: skip
