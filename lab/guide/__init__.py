"""The guide: the lesson's steps, and which of them the workspace shows to be done."""
