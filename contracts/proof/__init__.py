"""The prover: every reachable state of a contract's missions, explored through the real gate and the real machine."""

from crew.contracts.proof.checker import check, check_all
from crew.contracts.proof.report import Fallback, Finding, Report

__all__ = ["Fallback", "Finding", "Report", "check", "check_all"]
