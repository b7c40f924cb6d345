// manifests.js FOLDER FILE...: each manifest of Kubernetes is valid by the npm package kubernetes-models: by its schemas, which know values,
// and by its types, which know all keys. So that this says something, a misspelled key and a wrong type are found. FOLDER has the packages.
'use strict'
const { execFileSync } = require('child_process')
const fs = require('fs')
const path = require('path')
const folder = path.resolve(process.argv[2])
const yaml = require(`${folder}/node_modules/yaml`)

const module_of = ({ apiVersion, kind }) => `kubernetes-models/${apiVersion}/${kind}`
const fault_of_values = (manifest) => {
  try {
    const model = require(`${folder}/node_modules/${module_of(manifest)}`)[manifest.kind]
    new model(manifest).validate()
    return ''
  } catch (error) {
    return error.message
  }
}
const fault_of_keys = (manifest) => {
  const text = `import { I${manifest.kind} } from '${module_of(manifest)}'\nexport const manifest: I${manifest.kind} = ${JSON.stringify(manifest, null, 1)}\n`
  fs.writeFileSync(`${folder}/manifest.ts`, text)
  try {
    execFileSync(`${folder}/node_modules/.bin/tsc`, ['--noEmit', '--strict', '--skipLibCheck', '--target', 'es2022', '--module', 'commonjs',
      '--moduleResolution', 'node10', '--ignoreDeprecations', '5.0', '--typeRoots', 'none', 'manifest.ts'], { cwd: folder, stdio: 'pipe' })
    return ''
  } catch (error) {
    return error.stdout.toString()
  }
}

let failures = 0
const expect = (holds, text, more = '') => {
  console.log(`${holds ? 'ok' : 'not ok'} - ${text}${holds ? '' : `\n${more}`}`)
  failures += !holds
}
const manifests = process.argv.slice(3).map((file) => [file, yaml.parse(fs.readFileSync(file, 'utf8'), { strict: true, uniqueKeys: true })])
for (const [file, manifest] of manifests) {
  const values = fault_of_values(manifest), keys = fault_of_keys(manifest)
  expect(!values, `${file}: values of ${manifest.apiVersion} ${manifest.kind}`, values)
  expect(!keys, `${file}: keys`, keys)
}
const deployment = manifests.find(([, manifest]) => manifest.kind === 'Deployment')[1]
const misspelled = structuredClone(deployment)
misspelled.spec.template.spec.terminationGracePeriod = 50
expect(/terminationGracePeriod.* does not exist/.test(fault_of_keys(misspelled)), 'a misspelled key would be found')
const wrong = structuredClone(deployment)
wrong.spec.template.spec.containers[0].env[1].value = 8080
expect(fault_of_values(wrong), 'as would a number where Kubernetes expects a text')
process.exit(failures > 0 ? 1 : 0)
