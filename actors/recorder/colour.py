"""What each tone looks like, on a dark page: one meaning, one colour, in lanes, log, graph and scene alike."""

TONES = {
    "plan": 0x9575CDFF,
    "ask": 0x26C6DAFF,
    "hold": 0xFFB300FF,
    "run": 0x42A5F5FF,
    "allow": 0x90CAF9FF,
    "good": 0x66BB6AFF,
    "bad": 0xEF5350FF,
    "safe": 0xAB47BCFF,
    "stop": 0xFF1744FF,
    "value": 0xFF8A65FF,
    "idle": 0x78909CFF,
    "pending": 0x546E7AFF,
    "absent": 0x37474FFF,
    "skill0": 0x42A5F5FF,
    "skill1": 0x26A69AFF,
    "skill2": 0x5C6BC0FF,
    "skill3": 0x9CCC65FF,
    "skill4": 0x29B6F6FF,
    "skill5": 0x00897BFF,
    "skill6": 0x7986CBFF,
    "skill7": 0xAED581FF,
}
"""Tone to RGBA."""
ROBOTS = (0x4FC3F7FF, 0xFFD54FFF, 0x81C784FF, 0xF06292FF, 0xBA68C8FF, 0xFF8A65FF)
"""Robots in the order of the crew file: trails, labels and curves."""
FLOOR = (38, 46, 54, 255)
BORDER = 0x607D8BFF
OBSTACLE = 0x8D6E63FF


def robot_colour(number: int) -> int:
    """The colour of the robot with this place in the crew."""
    return ROBOTS[number % len(ROBOTS)]


def faint(colour: int, alpha: int = 60) -> int:
    """The same colour, see-through."""
    return colour & ~0xFF | alpha
