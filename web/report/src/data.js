// SPDX-License-Identifier: Apache-2.0
// The data that the program left in the page (src/io/report): a header in JSON, and blocks of packed numbers, each
// unpacked when it is first needed.

export const header = JSON.parse(document.getElementById("talus-header").textContent);

const unpacked = new Map();

async function bytesOf(block) {
  const element = document.getElementById(`talus-block-${block}`);
  const text = atob(element.textContent);
  const bytes = new Uint8Array(text.length);
  for (let n = 0; n < text.length; ++n) bytes[n] = text.charCodeAt(n);
  element.textContent = ""; // packed and unpacked need not both be kept
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

function once(block, unpack) {
  if (!unpacked.has(block)) unpacked.set(block, bytesOf(block).then(unpack));
  return unpacked.get(block);
}

/** Codes of all frames, `perFrame` each: value = low + code (high - low)/(levels - 1), code `levels` is none. */
export function frames(block, perFrame) {
  return once(block, (bytes) => {
    const count = bytes.length / 2;
    const codes = new Uint16Array(count);
    for (let n = 0; n < count; ++n) codes[n] = bytes[n] | (bytes[count + n] << 8);
    for (let n = perFrame; n < count; ++n) codes[n] += codes[n - perFrame];
    return codes;
  });
}

/** Numbers in single precision. */
export function numbers(block) {
  return once(block, (bytes) => {
    const count = bytes.length / 4;
    const words = new Uint32Array(count);
    for (let n = 0; n < count; ++n)
      words[n] = bytes[n] | (bytes[count + n] << 8) | (bytes[2 * count + n] << 16) | (bytes[3 * count + n] << 24);
    return new Float32Array(words.buffer);
  });
}

export function decode(packed, code) {
  return code === packed.levels ? NaN : packed.low + (code * (packed.high - packed.low)) / (packed.levels - 1);
}
