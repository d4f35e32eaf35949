"""The package's own files as text: parsed with positions, never imported or run."""
