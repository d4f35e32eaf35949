"""What every other package stands on: errors, translation, plain text, folders, positioned YAML."""
