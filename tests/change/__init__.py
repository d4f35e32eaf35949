"""Tests of the operators: changes of a program that may help a failed check."""
