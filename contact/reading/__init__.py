"""Text and numbers of files as they come: encodings, separators, headings."""
