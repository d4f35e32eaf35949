"""The sandboxes in which a submission's commands run: `docker`, `bubblewrap`, `account`, `none`.

All implement `grader.sandbox.base.Sandbox`; `grader.sandbox.choose` selects one.
"""
