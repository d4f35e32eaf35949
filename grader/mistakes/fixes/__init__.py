"""The fix as a patch: fixes of what beginners get wrong, where only one fix is possible.

A fix is a pure function of a package's files and a verdict on them: it returns the files as they
would be, or None where it is not certain. Nothing here runs the student's code or writes a file,
except `apply`, which writes to the student's own copy when asked to.
"""
