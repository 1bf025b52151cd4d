"""Files of any content: TOML and CSV read with clear refusals, writing all or nothing."""
