// Bundled into one classic script: a page of the file system cannot import modules.
import * as pc from "playcanvas";
import * as fresnel from "./fresnel.js";

Object.assign(globalThis, { pc, fresnel });
