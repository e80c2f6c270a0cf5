"""What a user gives for a contact: separation, creepage, material; what is hardly meant."""
