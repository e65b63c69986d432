// Checks the animations of robots with Khronos's validator of glTF 2.0 (npm package `gltf-validator`, version 2.0.0-dev.3.10).
//
//     npm install gltf-validator
//     node testdata/scripts/validate_gltf.js out/two-link-arm/motion.gltf out/six-joint-arm/motion.gltf out/four-bar/motion.gltf
//
// It prints the counts of errors, warnings, infos and hints of each file; all are zero.

const fs = require("fs");
const validator = require("gltf-validator");

(async () => {
  for (const path of process.argv.slice(2)) {
    const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(path)), { uri: path });
    const { numErrors, numWarnings, numInfos, numHints, messages } = report.issues;
    console.log(path, numErrors, numWarnings, numInfos, numHints, messages.map((message) => message.message).join("; "));
    process.exitCode ||= numErrors + numWarnings;
  }
})();
