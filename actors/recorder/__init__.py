"""The recorder: draws a run as it happens, or again from its journal. The only code that knows Rerun."""
