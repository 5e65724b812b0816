"""Reading what people write: contract and crew files, with errors that point at the node. Text in, structs out."""
