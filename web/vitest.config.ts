import { defineConfig } from "vitest/config";

export default defineConfig({
  test: {
    environment: "node",
    // on a machine with much else to do
    testTimeout: 240_000,
    hookTimeout: 240_000,
    // browser tests measure time: nothing beside them
    fileParallelism: false,
    cache: false,
  },
});
