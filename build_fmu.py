"""Build the FMUs: python build_fmu.py [--packaging python|native|all] [--out dist] [options]; --help lists them."""

try:
    from fmu_src.build import main
except ModuleNotFoundError as error:
    raise SystemExit(f"{error}: install the build requirements with  pip install '.[fmu,native]'") from None

if __name__ == "__main__":
    main()
