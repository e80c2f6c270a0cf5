"""Normal contact: separation and load in, strips with semi-elliptic pressure out. One method a file."""
