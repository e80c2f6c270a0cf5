"""From solver to FMU: tables of variables, descriptions made from them, and the packagings."""
