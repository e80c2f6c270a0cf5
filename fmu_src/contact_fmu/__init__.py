"""FMUs of the solver: tables of variables, model descriptions made from them, and two packagings."""
