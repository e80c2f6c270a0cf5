"""Normal contact: from separation and load to strips with semi-elliptic pressure. One method per file."""
