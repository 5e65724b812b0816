"""The crew's bus: one port, an implementation over Zenoh and one in memory with the same semantics."""

from crew.bus.port import Body, Bus, Declaration, Inbox, Publisher, Qos, Reply, Sample, packed

__all__ = ["Body", "Bus", "Declaration", "Inbox", "Publisher", "Qos", "Reply", "Sample", "packed"]
