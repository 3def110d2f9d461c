// Opens a glTF or PLY file with a reader that is not ours, and prints what it found as JSON.
//     node open.js FILE
"use strict";

const fs = require("fs");
const validator = require("gltf-validator");
const parsePly = require("parse-ply");

/// The Khronos validator's report.
function openGltf(file) {
  return validator.validateBytes(new Uint8Array(fs.readFileSync(file)), { uri: file });
}

/// Every element's properties, each a list.
function openPly(file) {
  return new Promise((resolve) => {
    const lists = (element) =>
      Object.fromEntries(Object.entries(element).map(([name, values]) => [name, [...values]]));
    parsePly(fs.createReadStream(file, { highWaterMark: 1 << 24 }), (error, elements) => {
      if (error) return resolve({ error: String(error) });
      const read = Object.entries(elements).map(([name, element]) => [name, lists(element)]);
      return resolve(Object.fromEntries(read));
    });
  });
}

const file = process.argv[2];
const reading = file.endsWith(".ply") ? openPly(file) : openGltf(file);
reading.then((found) => console.log(JSON.stringify(found)));

