import { ServerClient, takeToken } from "./api/server.ts";
import { Studio } from "./studio.ts";

declare global {
  interface Window {
    keyline: Studio;
  }
}

const client = new ServerClient(takeToken(location, sessionStorage));
client.warm();
if (location.hash) history.replaceState(null, "", location.pathname);
window.keyline = new Studio(client, document.getElementById("studio") as HTMLElement);
void window.keyline.start();
