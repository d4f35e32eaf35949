"""The guide: shows the steps of the lesson and which of them are done in the workspace."""
