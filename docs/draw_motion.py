"""Draws _static/motion.gif, the moving picture of the first page: python docs/draw_motion.py."""

from pathlib import Path
from tempfile import TemporaryDirectory

from PIL import Image, ImageSequence

import cdcr

OUT = Path(__file__).parent / "_static" / "motion.gif"
WIDTH = 760  # [pixels]
COLOURS = 48
FPS = 12.0


def main() -> None:
    run = cdcr.scenarios.get("three-sections").simulate()
    with TemporaryDirectory() as folder:
        film = run.animate(Path(folder) / "film.gif", fps=FPS, speed=1.25)
        with Image.open(film) as frames:
            height = round(WIDTH * frames.height / frames.width)
            small = [
                frame.convert("RGB").resize((WIDTH, height), Image.Resampling.LANCZOS)
                for frame in ImageSequence.Iterator(frames)
            ]
    # One palette for all frames, so that what stands still stays the same to the bit.
    palette = small[len(small) // 2].quantize(COLOURS)
    quantized = [frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in small]
    quantized[0].save(
        OUT,
        save_all=True,
        append_images=quantized[1:],
        duration=round(1000 / FPS),
        loop=0,
        optimize=True,
    )
    print(f"{OUT}: {len(small)} frames, {OUT.stat().st_size / 1000:.0f} kB")


if __name__ == "__main__":
    main()
