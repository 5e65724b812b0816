"""The prover: every reachable state of a contract's missions, explored through the real gate and the real machine."""

from crew.contracts.proof.checker import LIMIT, Progress, Stage, check, check_all
from crew.contracts.proof.report import Fallback, Finding, Report

__all__ = ["LIMIT", "Fallback", "Finding", "Progress", "Report", "Stage", "check", "check_all"]
