// SPDX-License-Identifier: Apache-2.0
// Colour maps with even steps of lightness, and the colours of curves, all of which people who see few colours can tell
// apart. Maps: viridis, van der Walt & Smith, "mpl-colormaps" (2015); cividis, Nunez, Anderton & Renslow, PLoS ONE 13(7),
// e0199239 (2018); 33 equally spaced colours of each. Curves: Okabe & Ito, "Color universal design" (2008).

const maps = {
  viridis:
    "440154470d6048186a482374472d7b4537814240863e49893b528b375b8d33638d2f6b8e2c728e297a8e26828e23898e21918c1f988b1fa08822a78528ae8032b67a3fbc734ec36b5ec96270cf5784d44b98d83eaddc30c2df23d8e219ece51bfde725",
  cividis:
    "00224e00285b002e6a0533711a386f273e6e32436d3b496c434e6c4b546c535a6d5a5f6e61656f686a716f70737676767d7c788482798c8878938e789b9476a39a74aba072b4a76fbcae6cc4b468cdbb63d5c25edec958e7d150f0d846f9e03afee838",
};

export const mapNames = Object.keys(maps);

/** 256 colours, RGBA bytes. */
export function colours(name) {
  const hex = maps[name];
  const last = hex.length / 6 - 1;
  const bytes = new Uint8Array(256 * 4);
  for (let n = 0; n < 256; ++n) {
    const place = (n / 255) * last;
    const below = Math.min(Math.floor(place), last - 1);
    for (let c = 0; c < 3; ++c) {
      const at = (k) => parseInt(hex.substr(6 * k + 2 * c, 2), 16);
      bytes[4 * n + c] = Math.round(at(below) + (place - below) * (at(below + 1) - at(below)));
    }
    bytes[4 * n + 3] = 255;
  }
  return bytes;
}

export const curves = {
  light: ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8a6d00", "#3b3b3b"],
  dark: ["#56b4e9", "#e69f00", "#3fc79a", "#e2a3c7", "#f0e442", "#dddddd"],
};
export const dashes = [[], [8, 4], [2, 3], [10, 3, 2, 3], [4, 2], [1, 2]];
