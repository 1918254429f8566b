import { defineConfig } from "vitest/config";

export default defineConfig({
  // not by a name: systems without /etc/hosts know no localhost
  server: { host: "127.0.0.1" },
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
