"use strict";
/* Read profile files as the page does: node profiles.js RULES KIND FILE ... Print one result a line. KIND is wheel, rail or any. */

const fs = require("fs"), path = require("path");
const { readProfile, ProfileError } = require(path.join(__dirname, "../../explorer/page/profile.js"));
const [rules, kind, ...names] = process.argv.slice(2), numbers = JSON.parse(rules);
for (const name of names) {
  const content = fs.readFileSync(name);
  try {
    const found = readProfile(content.buffer.slice(content.byteOffset, content.byteOffset + content.length), kind === "any" ? null : kind, numbers);
    console.log(JSON.stringify({ ...found, numbers: [...found.numbers] }));
  } catch (error) {
    if (!(error instanceof ProfileError)) throw error;
    console.log(JSON.stringify({ error: error.message }));
  }
}
