"""Results as tables, units, HTML and text. Pictures are in `contact.plot`."""
