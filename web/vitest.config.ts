import { defineConfig } from "vitest/config";

export default defineConfig({
  test: {
    environment: "node",
    testTimeout: 60_000,
    hookTimeout: 60_000,
    // browser tests measure time: nothing beside them
    fileParallelism: false,
    cache: false,
  },
});
