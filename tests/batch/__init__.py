"""Marking a whole class: downloads, roster, workers, ledger and policy."""
