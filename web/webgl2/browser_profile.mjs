import {existsSync, rmSync} from "node:fs";

/** Removes the profile of a browser that ended. Its child processes may still write there for a moment. */
export async function removeProfile(folder) {
  for (let tries = 0; existsSync(folder); ++tries) {
    try {
      rmSync(folder, {recursive: true, force: true});
    } catch (error) {
      if (tries === 100) throw error;
      await new Promise((done) => setTimeout(done, 100));
    }
  }
}
