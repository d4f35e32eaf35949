"""Where a submission's commands may run: `bubblewrap`, `account`, `none` (and `docker`).

All offer the interface of `grader.sandbox.base.Sandbox`; `grader.sandbox.choose` picks one.
"""
