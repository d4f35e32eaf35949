"""What every other part uses: errors, folders, texts and their translation."""
