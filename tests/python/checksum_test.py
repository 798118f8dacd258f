"""XXH3-64 against what libxxhash 0.8.1 (XXH3_64bits) makes of the first bytes of one sequence."""
import unittest

import numpy as np

import lore

# Every way through the algorithm: up to 3, 8, 16, 128, 240 bytes, and blocks of 1024.
EXPECTED = {
    0: "2d06800538d394c2",
    1: "e5e62017e96f839c",
    2: "e99f8ba75698ec0f",
    3: "d3bcc83c6f14e70f",
    4: "c7f159f34b126cb4",
    8: "0f25a2a1cc43dda2",
    9: "1e3be9699baa50cf",
    16: "9ec324145cea1dcb",
    17: "48f3651d7436310a",
    32: "3ecd923442085a0d",
    33: "0afebb54eff3a3b5",
    64: "7abe508541644d25",
    65: "da2a9fa52b7fadf5",
    96: "014dbb30ecd7c670",
    97: "7b0a9dae42e89ff6",
    128: "5d813d42c0005ea8",
    129: "c61639b552225575",
    143: "59339bd5e6a8a208",
    144: "9e69d5b5f04a37c8",
    240: "7d85b8d4f8b10c82",
    241: "5c56141c894cd97e",
    320: "fe6e6426ff966b51",
    1024: "0551dea22e104ea8",
    1025: "dbe2ed3c377d9922",
    1100: "cee00ccd5d8f1500",
    2048: "0e137a69a82b62c0",
    2049: "2ba993b30fe87e40",
    65537: "d47f6fc3e6410610",
    300000: "71be5eb7dcd8cefe",
}


def sequence(length: int) -> bytes:
    """The upper bytes of a linear congruential generator."""
    state, made = 1, bytearray()
    for _ in range(length):
        state = (state * 1103515245 + 12345) & 0xFFFFFFFF
        made.append(state >> 16 & 255)
    return bytes(made)


class Checksum(unittest.TestCase):
    def test_is_that_of_the_c_library_for_every_length(self) -> None:
        data = sequence(max(EXPECTED))
        for length, expected in EXPECTED.items():
            with self.subTest(length=length):
                self.assertEqual(lore.checksum_text(lore.xxh3_64(data[:length])), expected)

    def test_does_not_depend_on_where_the_first_part_ends(self) -> None:
        data = sequence(3000)
        whole = lore.xxh3_64(data)
        for first in (1, 56, 1023, 1024, 1025, 2999):
            self.assertEqual(lore.xxh3_64(np.frombuffer(data, np.uint8)[first:], data[:first]), whole)


if __name__ == "__main__":
    unittest.main()
