// node gltf_validator.js MODULE FILE…: what the validator of the Khronos Group says about glTF files, as JSON.
const { readFileSync } = require("fs");
const [module_path, ...files] = process.argv.slice(2);
const validator = require(module_path);

Promise.all(files.map((file) => validator.validateBytes(new Uint8Array(readFileSync(file)), { maxIssues: 0 }))).then(
  (reports) => console.log(JSON.stringify(reports.map((report) => report.issues.messages))),
  (error) => {
    console.error(String(error));
    process.exit(1);
  },
);
