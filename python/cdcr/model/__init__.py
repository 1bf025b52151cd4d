"""The model and the answers it gives: statics, modes, stability, coordinates, wrenches."""
