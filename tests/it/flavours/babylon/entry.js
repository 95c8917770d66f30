// Bundled into one classic script: a page of the file system cannot import modules.
import * as BABYLON from "@babylonjs/core";
import * as fresnel from "./fresnel.js";

Object.assign(globalThis, { BABYLON, fresnel });
