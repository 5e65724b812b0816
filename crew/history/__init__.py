"""What a run did, folded from its journal. Reads and arranges; judges nothing."""
