(()=>{var{find:X,make:w}=document.currentScript.shared;var{CanvasPen:K}=document.currentScript.shared;var{HALO_WIDTH:J,SERIF:N,STYLES:Z,colours:R}=document.currentScript.shared;var{writeNumber:O}=document.currentScript.shared;var{LIGHT:Q,Pen:ee,cornersOf:te,textParts:ne,traceDisc:se}=document.currentScript.shared;var{counted:S}=document.currentScript.shared;var{along:ae}=document.currentScript.shared;var{tableLonlat:oe}=document.currentScript.shared;var{lonLatOf:L}=document.currentScript.shared;var{asCount:M}=document.currentScript.shared;var{Kept:F,filled:U,run:re}=document.currentScript.shared;var Me=3,Ie=3,ze=class extends ee{#t=[];#e=[];text(e){let[n,t]=[g(this.width),g(this.height)];return`${[`<svg xmlns="http://www.w3.org/2000/svg" width="${n}" height="${t}" viewBox="0 0 ${n} ${t}">`,`<title>${H(e)}</title>`,...this.#t.length>0?[`<defs>${this.#t.join("")}</defs>`]:[],`<rect width="${n}" height="${t}" ${x("fill",this.colours.paper)}/>`,`<g fill="none" stroke-linecap="round" stroke-linejoin="round" font-family='${N}'>`,...this.#e].join(`
`)}
</g>
</svg>
`}path(e,n,t,s){let a=ie(n);if(a==="")return;let o=[];s.fill!==void 0&&o.push(x("fill",t??this.colours[s.fill],s.fillOpacity)),s.stroke!==void 0&&o.push(this.#n(s,t)),this.#e.push(`<path class="${e}" ${o.join(" ")} d="${a}"/>`)}within({opacity:e=1,region:n,corner:t},s){let a=`clip-${this.#t.length}`;n&&this.#t.push(`<clipPath id="${a}"><path d="${ie(n)}"/></clipPath>`);let o=n?` clip-path="url(#${a})"`:"",r=e<1?` opacity="${e}"`:"",c=t?` transform="translate(${t.map(g).join(" ")})"`:"";this.#e.push(`<g${o}${r}${c}>`),s(),this.#e.push("</g>")}discs(e,n,t){let{radius:s,fill:a,rim:o,rimWidth:r,opacity:c}=n,i=g(s-r/2),l=`dots-${this.#t.length}`,d=[];for(let p=0;p<t.length;p+=2)d.push(`<circle cx="${g(t[p])}" cy="${g(t[p+1])}" r="${i}"/>`);this.#t.push(`<g id="${l}">${d.join("")}</g>`);let h=`fill="none" ${x("stroke",this.colours[o],c)} stroke-width="${g(2*r)}"`;this.#e.push(`<use class="${e}-rim" href="#${l}" ${h}/>`),this.#e.push(`<use class="${e}" href="#${l}" ${x("fill",this.colours[a],c)}/>`)}spots(e,n){let t=this.#n(Z["spot-line"]);n.forEach((s,a)=>{let[o,r,c]=[e[3*a],e[3*a+1],e[3*a+2]].map(g);this.#e.push(`<circle class="spot" cx="${o}" cy="${r}" r="${c}" ${x("fill",s)} ${t}/>`)})}label(e,n,t,s){let a={left:"start",center:"middle",right:"end"}[s.align??"left"],o=ne(e,s.italic??!1).map(i=>i.italic?`<tspan font-style="italic">${H(i.text)}</tspan>`:H(i.text)).join(""),r=`paint-order="stroke" ${x("stroke",this.inkOf(s.halo))} stroke-width="${J}"`,c=`x="${g(n)}" y="${g(t)}" font-size="${s.size}" text-anchor="${a}"`;this.#e.push(`<text ${c} ${x("fill",this.inkOf(s.ink))} ${r}>${o}</text>`)}picture(e,n,t,s,a){if(e instanceof HTMLImageElement){let c=decodeURIComponent(e.src.slice(e.src.indexOf(",")+1));return this.within({corner:[n,t]},()=>this.#e.push(c))}let o=document.createElement("canvas");[o.width,o.height]=[e.width,e.height],o.getContext("2d").drawImage(e,0,0);let r=`x="${g(n)}" y="${g(t)}" width="${g(s)}" height="${g(a)}"`;this.#e.push(`<image ${r} preserveAspectRatio="none" href="${o.toDataURL("image/png")}"/>`)}#n(e,n=this.colours[e.stroke??"ink"]){let t=e.dash===void 0?"":` stroke-dasharray="${e.dash.join(" ")}"`;return`${x("stroke",n,e.strokeOpacity)} stroke-width="${g(e.width??1)}"${t}`}fillDisc({x:e,y:n,r:t},s){let a=typeof s=="string"?x("fill",s):`fill="url(#${s.id})"`;if(this.#e.push(`<circle ${a} cx="${g(e)}" cy="${g(n)}" r="${g(t)}"/>`),typeof s=="string")return;let o=s.stops.map(([i,l])=>`<stop offset="${i}" ${x("stop-color",l,1,"stop-opacity")}/>`),r=Object.entries(Q).map(([i,l])=>`${i}="${g((l+(i==="r"?0:1))/2)}"`),c=`<radialGradient id="${s.id}" ${r.join(" ")}>${o.join("")}</radialGradient>`;this.#t.includes(c)||this.#t.push(c)}};function ie(e){let n="";return e({moveTo:(t,s)=>n+=`M${g(t)} ${g(s)}`,lineTo:(t,s)=>n+=`L${g(t)} ${g(s)}`,ellipse(t,s,a,o,r,c,i,l=!1){let[d,h]=[Math.cos(r),Math.sin(r)],p=u=>{let[b,y]=[a*Math.cos(u),o*Math.sin(u)];return[t+b*d-y*h,s+b*h+y*d]};n===""?this.moveTo(...p(c)):this.lineTo(...p(c));let m=Math.ceil(Math.abs(i-c)/Ie),f=`${g(a)} ${g(o)} ${g(r*180/Math.PI)} 0 ${l?0:1}`;for(let u=1;u<=m;++u){let[b,y]=p(c+(i-c)*u/m);n+=`A${f} ${g(b)} ${g(y)}`}},closePath:()=>n+="Z"}),n}function g(e){return O(e,Me)}function x(e,n,t=1,s=`${e}-opacity`){let[a,o,r,c=1]=(n.match(/[\d.]+/g)??[]).map(Number),i=c*t,l=i===1?"":` ${s}="${g(i)}"`;return`${e}="rgb(${a}, ${o}, ${r})"${l}`}function H(e){return e.replace(/&/g,"&amp;").replace(/</g,"&lt;").replace(/>/g,"&gt;")}var $={lon:["longitude","lon","lng","long","longitud","longitudine","längengrad","laengengrad","долгота","经度","經度","経度","خط الطول"],lat:["latitude","lat","latitud","latitudine","breitengrad","широта","纬度","緯度","خط العرض"],unsure_lon:["x","xcoord","länge","laenge","الطول"],unsure_lat:["y","ycoord","breite","العرض"],beside:["coord","coords","coordinate","coordinates","point","geo","geogr","geographische","deg","degrees","grad"],missing:["","na","n/a","#n/a","nan","null","none","<na>","-","–"],compass:{E:"East Ost Osten Est Este Leste в.д. 东经 東経 شرقا",W:"West Westen Ouest Oeste Ovest з.д. 西经 西経 غربا",N:"North Nord Norden Norte с.ш. 北纬 北緯 شمالا",S:"South Süd Süden Sud Sur Sul ю.ш. 南纬 南緯 جنوبا"},lettered:"n\\W?s|e\\W?w|[nsew]|\\w*hem\\w*|\\w*(?:lat|lon)\\w*(?:ns|ew|[nsew]|dir|ref)|column_\\d+",zeros:"٠۰０",printed:"−–   　٫．，،",typed:"--    ..,,",unseen:"​‎‏\uFEFF",western:"°ºªà-öø-ÿÀ-ÖØ-ß€‘’“”–—«»²³µ ŒœŠšŽžŸ"},P=/^[-+]?(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:e[-+]?[0-9]+)?$/i,je=new Set($.missing),k=e=>je.has(e.trim().toLowerCase()),Ce=new RegExp(`\\0|[^\\x00-\\x7f${$.western}]|[^\\x00-\\x7f]{3}`),Fe="぀";function W(e,n=!1){let[t,s]=["lon","lat"].map(a=>{let[o,r]=[$[a],$[`unsure_${a}`]],l=[d=>o.includes(d),(d,h)=>o.some(p=>h.includes(p)||p>Fe&&d.includes(p)),(d,h)=>h.length>0&&h.every(p=>r.includes(p))].slice(0,n?2:3).map(d=>e.filter(h=>d(h.trim().toLowerCase(),Ue(h)))).find(d=>d.length>0);return l?.length===1?l[0]:null});return t===null||s===null||t===s?null:[t,s]}function Ue(e){return e.replace(/(?<=[a-z])(?=[A-Z])/g," ").toLowerCase().split(/[^\p{L}]+/u).filter(t=>t!==""&&!$.beside.includes(t))}var He=new RegExp(`^(?:${$.lettered})$`,"iu"),We=new RegExp(`[${$.printed}${$.unseen}]`,"gu");function I(e){return e.replace(We,t=>$.typed[$.printed.indexOf(t)]??"").trim().replace(/\s+/g," ")}var Ge=new Map(Object.entries({...$.compass,O:"O"}).flatMap(([e,n])=>[e,...n.toLowerCase().split(" ")].map(t=>[t,e]))),ge=e=>Ge.get(e.length>1?e.toLowerCase():e),le="[0-9]+(?:[.,][0-9]*)?",Ve=new RegExp(`^(?<before>[\\p{L}.]+)?\\s*(?<sign>[-+])?\\s*(?<degrees>[0-9]{1,3}(?:[.,][0-9]*)?)(?:\\s*(?:deg(?:rees?)?|[°º˚d:度]|\\s)\\s*(?:(?<minutes>${le})(?:\\s*(?:min|['′’‘´m:分]|\\s)\\s*(?:(?<seconds>${le})\\s*(?:''|’’|′′|["″”“秒]|sec|s)?)?)?)?)?\\s*(?<after>[\\p{L}.]+)?$`,"u");function qe(e){let n=e.length>200?null:Ve.exec(I(e))?.groups;if(!n)return null;let{before:t,after:s,sign:a}=n,o=[n.degrees,n.minutes,n.seconds].filter(h=>h!==void 0),r=o.map(h=>h.replace(",",".").replace(/\.$/,"")),c=t??s?ge(t??s):"",i=o.slice(0,-1).every(h=>/^[0-9]+$/.test(h));return c===void 0||t&&s||c&&a||!i||r.slice(1).some(h=>Number(h)>=60)?null:{degrees:(c==="W"||c==="S"||a==="-"?-1:1)*(c==="O"?NaN:Be(r)),point:c}}function Be(e){if(e.length===1)return Number(e[0]);let n=10**(e[e.length-1].split(".")[1]?.length??0);return e.reduce((t,s)=>60*t+Math.round(Number(s)*n),0)/(n*60**(e.length-1))}var me=/^[-+]?[1-9][0-9]{0,2}[.,][0-9]{3}$/,Ye=/^[-+]?0[0-9]/,Xe={longitude:"EWO",latitude:"NS"};function Ke(e){let[n,t]=["x","y"].map(s=>e.filter(a=>a.trim().toLowerCase()===s));return n.length===1&&t.length===1?[n[0],t[0]]:e.length===2?[e[0],e[1]]:null}function Je(e,n,t){let s=n==="plane"?ye(e.columns):"",a=i=>_e(i,s)?NaN:$e(i),[o,r]=t.map((i,l)=>n==="lonlat"?Qe(e,i,["longitude","latitude"][l]):xe(e,i,e.columns.get(i),"a number without a mark between thousands",a)),c=Float64Array.from({length:2*o.length},(i,l)=>(l%2===0?o:r)[l>>1]);return n==="lonlat"?be(c,e.wrong):c}function be(e,n){for(let t=0;t<e.length/2;++t){let[s,a]=e.subarray(2*t,2*t+2);n.has(t)||Math.abs(a)<=90&&Math.abs(s)<=360||n.set(t,`longitude ${s}, latitude ${a} is not on Earth; are they swapped, or not in degrees?`)}return e}function Ze(e,n){let t=ye(e),s=c=>P.test(c)&&!Ye.test(c)&&!_e(c,t),a=c=>k(c)||s(c.trim()),o=[...e].filter(([c,i])=>!n.has(c)&&i.every(a)&&!i.every(k)),r=c=>k(c)?NaN:ve(c.trim());return new Map(o.map(([c,i])=>[c,Float64Array.from(i,r)]))}function ye(e){let t=[...e.values()].flatMap(s=>s.filter(a=>/[.,]/.test(a))).map(s=>s.trim()).filter(s=>P.test(s)&&!me.test(s));return[...new Set(t.map(we))].join("")||"."}var we=e=>e.includes(",")?",":".",_e=(e,n)=>me.test(e)&&we(e)!==n,ve=e=>Number(e.replace(",","."));function Qe(e,n,t){let s=Xe[t],a=`degrees with a sign, ${s[0]} or ${s[1]}`;return xe(e,t,et(e,n,s),a,o=>{let r=P.test(o)?null:qe(o);return r===null?$e(o):s.includes(r.point)?r.degrees:NaN})}function et({columns:e},n,t){let[s,a]=[e.get(n),[...e.keys()]],o=a[a.indexOf(n)+1]??"";if(!He.test(o))return s;let r=e.get(o).map(l=>k(I(l))?"":I(l)),c=r.filter(Boolean).map(l=>ge(l)??"?");return!(c.length>0&&c.every(l=>t.includes(l)))||s.some(l=>I(l).includes("-")&&!k(l))?s:s.map((l,d)=>k(l)?"":`${l} ${r[d]}`.trim())}var $e=e=>P.test(e)?ve(e):NaN;function xe({wrong:e},n,t,s,a){return Float64Array.from(t,(o,r)=>{let c=o.trim(),i=a(c);return Number.isFinite(i)?i:(e.has(r)||e.set(r,`the ${n} is ${k(c)?"missing":`'${c}', not ${s}`}`),NaN)})}var tt=[",",";","	","|"],nt=50,st=20,Se=/\r\n|\n|\r/,at=/^(?:[ \t]*#[^\r\n]*(?:\r\n?|\n|$))+/;function ot(e){let n=e.replace(at,""),t=rt(n),a=(t===null?n.split(Se).map(Ee):[...it(n,t)]).filter(f=>f.some(u=>u.trim()!==""));if(a.length===0)throw new v("the table is empty");let{names:o,data:r}=lt(a),c=r.length<a.length,i=o.find((f,u)=>f!==""&&o.indexOf(f)!==u);if(i!==void 0)throw new v(`there are several columns with the name '${i}'`);let l=o.map(()=>[]),d=new Map,h=o.reduce((f,u,b)=>u===""?f:b+1,0);r.forEach((f,u)=>{f.length>=h&&f.slice(o.length).every(y=>y==="")||d.set(u,`it has ${f.length} in place of ${o.length} fields`),l.forEach((y,A)=>y.push(f[A]??""))});let m=o.map((f,u)=>[f||`column_${u+1}`,l[u]]).filter(([,f],u)=>o[u]!==""||f.some(b=>b!==""));return{columns:new Map(m),count:r.length,isHeaded:c,wrong:d}}function rt(e){let n=e.split(Se,nt).filter(i=>i.trim()!==""),t=n.map(i=>i.replace(/"[^"]*"/g,"")),a=tt.map(i=>({mark:i,widths:t.map(l=>l.split(i).length)})).filter(({widths:i})=>Math.max(0,...i)>1),o=a.filter(({widths:i})=>new Set(i).size===1),r=[...new Set(n.map(i=>Ee(i).length))];if(a.length===0||o.length===0&&r.length===1&&r[0]>1)return null;let c=({widths:i})=>Math.max(...i.map(l=>l>1?1e6*i.filter(d=>d===l).length+l:0));return(o.length>0?o:a).reduce((i,l)=>c(l)>c(i)?l:i).mark}var Ee=e=>e.trim().split(/\s+/);function*it(e,n){let t=`[^"\\${n}\\r\\n][^\\${n}\\r\\n]*`,s=new RegExp(`(?:"([^"]*(?:""[^"]*)*)"|(${t})?)(\\${n}|\\r\\n|\\n|\\r|$)`,"y"),a=[];for(;s.lastIndex<e.length;){let o=s.lastIndex,r=s.exec(e);if(r===null)throw new v(`in ${e.slice(o,o+20)}… a quotation mark does not end a field; write it twice`);a.push(r[1]?.replaceAll('""','"')??r[2]??""),r[3]!==n&&(yield a,a=[])}a.length>0&&(yield[...a,""])}function lt(e){let n=e.slice(0,st).map(l=>l.map(d=>d.trim())),t=n.map(l=>l.filter(d=>d!=="")),s=l=>P.test(l),a=t.findIndex((l,d)=>W(l)!==null&&(d===0||!l.some(s))),o=t.findIndex(l=>l.length>1),r=Math.max(0,a>=0?a:o);return a<0&&2*t[r].filter(s).length>t[r].length?{names:n[r].length===2?["lon","lat"]:n[r].map((l,d)=>`column_${d+1}`),data:e.slice(r)}:{names:n[r],data:e.slice(r+1)}}function ct(e,n,t=null,s=new Map){let a=i=>typeof i=="string"?/[",\r\n]/.test(i)?`"${i.replaceAll('"','""')}"`:i:Object.is(i,-0)?"-0.0":Number.isFinite(i)?String(i):"",o=new Map([...t?[["name",t]]:[],...s]),r=[...e,...o.keys()],c=Array.from({length:n.length/2},(i,l)=>[n[2*l],n[2*l+1],...Array.from(o.values(),d=>d[l])]);return[r,...c].map(i=>`${i.map(a).join()}
`).join("")}var v=class extends Error{columns;constructor(e,n=[]){super(e),this.columns=n}};function dt(e){let n=pt(e),t=E(n,"type")==="Feature"?[n]:E(n,"features");if(!Array.isArray(t))throw new v("the file is not a GeoJSON FeatureCollection of points");let s=new Map,a=t.map((l,d)=>{let h=ft(l);return typeof h=="string"&&s.set(d,h),typeof h=="string"?[NaN,NaN]:h}),o=be(Float64Array.from(a.flat()),s),r=t.map(l=>E(l,"properties")),c=new Set(r.flatMap(l=>Object.keys(l??{}))),i=new Map([...c].map(l=>[l,r.map(d=>ht(E(d,l)))]));return{places:o,table:{columns:i,count:t.length,isHeaded:!0,wrong:s}}}function ht(e){return typeof e=="object"?JSON.stringify(e??void 0)??"":String(e??"")}function E(e,n){return typeof e=="object"&&e!==null?e[n]:void 0}function pt(e){try{return JSON.parse(e)}catch(n){throw new v(`the file is not JSON: ${n instanceof Error?n.message:String(n)}`)}}function ft(e){let n=E(e,"geometry"),[t,s]=[E(n,"type"),E(n,"coordinates")],a=t==="MultiPoint"&&Array.isArray(s)&&s.length===1;if(t!=="Point"&&!a)return`a Point is needed, not ${typeof t=="string"?t:"no geometry"}`;let o=a?s[0]:s,r=Array.isArray(o)?o.slice(0,2):[];return r.length===2&&r.every(Number.isFinite)?r:`a Point has two or three coordinates, not ${JSON.stringify(o)}`}var ce=1e6;function ut(e,n,t,s){let a=bt(n,e),o=/^\s*[{[]/.test(a);if(o&&t==="plane")return{room:"globe"};let r=o?dt(a):mt(a,t,s);if("room"in r)return r;let{places:c,table:i,axes:l=[]}=r,{count:d,wrong:h}=i;if(d===0)throw new v("there are no points");if(d>ce){let b=`the page takes up to ${S(ce)}; for more there is the Python library`;throw new v(`there are ${S(d)} points; ${b}`)}let p=h.size===0?"":gt(i);if(h.size===d)throw new v(p);let m=(b,y)=>!h.has(y),f=new Map([...i.columns].map(([b,y])=>[b,y.filter(m)])),u=[...f.keys()].find(b=>b.trim().toLowerCase()==="name")??"";return{file:e,places:c.filter((b,y)=>m(0,y>>1)),names:f.get(u)??null,values:Ze(f,new Set([...l,u])),leftOut:h.size,wrong:p}}function gt({count:e,wrong:n}){let t=[...n.keys()].reduce((a,o)=>Math.min(a,o));return`${n.size===e?"No row can":`${S(n.size)} of ${S(e)} rows cannot`} be placed. Row ${S(t+1)}: ${n.get(t)}`}function mt(e,n,t){let s=ot(e),a=[...s.columns.keys()],o=s.isHeaded?W(a,!0):null,r=t??(n==="lonlat"?W(a):Ke(a));if(r===null&&o!==null)return{room:"globe"};if(r===null)throw new v("the table has no two columns of coordinates",a);let c=Je(s,n,r),i=[...s.wrong.keys()].filter(l=>Number.isFinite(c[2*l]+c[2*l+1]));return n==="lonlat"&&o===null&&2*i.length>s.count?{room:"lift",columns:r}:{places:c,table:s,axes:r}}function bt(e,n){let t=String.fromCharCode(...e.subarray(0,2)),s=/^(\xff\xfe|[^\0]\0)/.test(t)?"utf-16le":/^(\xfe\xff|\0)/.test(t)?"utf-16be":null,a=s===null?["utf-8","windows-1252"]:[s];for(let c of a)try{let i=new TextDecoder(c,{fatal:!0}).decode(e),l=c==="windows-1252";if(!/\0|^\s*</.test(i)&&!(l&&Ce.test(i)))return i}catch{}let o=/^[\w.-]+$/.test(n)?n:`"${n}"`,r="neither a picture nor a table in text that the page can read";throw new v(`${r}; to make a page of it, type: stereodel web ${o}`)}async function ke(e,n,t,s,a){if(e.type.startsWith("image/"))return t.pass("globe",e);let{messages:o}=t,r=`${e.name}:`,c=i=>`${i}${/[.?!]$/.test(i)?"":"."} Nothing has changed.`;try{let i=ut(e.name,new Uint8Array(await e.arrayBuffer()),n,a);if("room"in i)return t.pass(i.room,e,i.columns);let{leftOut:l,wrong:d}=i,h=()=>{o.close(),s(i)};if(l===0)return h();let p=l===1?"this row":`these ${S(l)} rows`;o.show(r,c(d),{words:`Open without ${p}`,act:h})}catch(i){if(!(i instanceof v))throw i;let{message:l,columns:d}=i;if(d.length<2)return o.show(r,c(l));let h=(n==="lonlat"?["Longitude","Latitude"]:["x","y"]).map((m,f)=>{let u=w("select","",...d.map(b=>w("option","",b)));return u.selectedIndex=f,w("label","field column",`${m} `,u)}),p=()=>{let[m,f]=h.map(u=>X(u,"select").value);return ke(e,n,t,s,[m,f])};o.show(`Which columns of ${e.name}?`,"",{words:"Open",act:()=>{p()}},h)}}var yt=7;function wt(e,n="spherical"){return`{"type":"FeatureCollection","features":[
${e.map(({properties:s,corners:a})=>{let o=a.length===0?_t:vt(a,n);return JSON.stringify({type:"Feature",properties:s,geometry:o})}).join(`,
`)}
]}
`}var _t={type:"Polygon",coordinates:[[...te(-180,-90,180,90),[-180,-90]]]};function vt(e,n){let t=$t(e.flatMap((c,i)=>ae(c,e[(i+1)%e.length])),n),s=Math.round((t[t.length-1][0]-t[0][0])/360),a=s===0?t:xt(t,s),o=c=>Number(c.toFixed(yt)),r=St(a).map(c=>[c.map(([i,l])=>[o(i),o(l)])]);return r.length===1?{type:"Polygon",coordinates:r[0]}:{type:"MultiPolygon",coordinates:r}}function $t(e,n){let t=oe(Float64Array.from([...e,e[0]].flatMap(L)),n),s=[];for(let a=0;a<t.length;a+=2){let o=s[s.length-1]?.[0]??t[a];s.push([t[a]+360*Math.round((o-t[a])/360),t[a+1]])}return s}function xt(e,n){let t=n>0?90:-90,s=n>0?[...e]:[...e].reverse(),a=360*Math.ceil((s[0][0]-180)/360)+180,o=s.findIndex(([h])=>h>=a),r=Re(s[Math.max(0,o-1)],s[o===-1?s.length-1:o],a),c=s.slice(Math.max(o,0),-1).map(([h,p])=>[h-a-180,p]),i=s.slice(0,Math.max(o,0)).map(([h,p])=>[h-a+180,p]),l=[[-180,r],...c,...i,[180,r]],d=n>0?l:l.reverse();return[...d,[d[d.length-1][0],t],[d[0][0],t],d[0]]}function Re(e,n,t){return e[0]===n[0]?e[1]:e[1]+(t-e[0])/(n[0]-e[0])*(n[1]-e[1])}function St(e){let n=e.map(([o])=>o),t=Math.floor((Math.min(...n)+180)/360),s=Math.ceil((Math.max(...n)+180)/360),a=[];for(let o=t;o<Math.max(s,t+1);++o){let r=e.slice(0,-1).map(([i,l])=>[i-360*o,l]),c=de(de(r,-180,1),180,-1);c.length>2&&a.push([...c,c[0]])}return a}function de(e,n,t){let s=[];return e.forEach((a,o)=>{let r=e[(o+1)%e.length],[c,i]=[t*(a[0]-n)>=0,t*(r[0]-n)>=0];c&&s.push(a),c!==i&&a[0]!==n&&r[0]!==n&&s.push([n,Re(a,r,n)])}),s}var he=Float64Array.of(-Math.PI,-Math.PI/2,Math.PI,Math.PI/2),pe=2**15,Et=class{width;height;texels;levels;constructor(e,n){if(this.width=M(n,"width",2,2**20),this.height=n/2,e.length!==4*this.width*this.height){let a=`four for each of ${n} × ${this.height} pixels: a picture of the whole globe`;throw new RangeError(`pixels has ${e.length} numbers, and not ${a} is twice as wide as high`)}this.texels=new F(kt(e));let t=re(a=>a.call("raster_levels_size",this.width,this.height)),s=[this.texels,this.width,this.height,he];this.levels=new F(U(Uint8Array,t,"raster_levels",...s))}warp(e,n){return this.painted(e,[-1,1,2/n,2/n],n,n)}painted(e,n,t,s,a=!0){M(t,"width",1,pe),M(s,"height",1,pe);let o=e.inverse(),r=Float64Array.of(...o.right.matrix,o.magnification,...o.left.matrix,0),i=[...[this.texels,this.levels,this.width,this.height,he],r,Float64Array.of(...n),t,s,a?1:0];return U(Uint8ClampedArray,4*t*s,"warp_raster",...i)}};function kt(e){let n=Uint8Array.from(e);for(let t=0;t<n.length;++t)t%4!==3&&(n[t]=Math.floor((n[t]*n[t|3]+127)/255));return n}var Rt=4096,Lt=2,Pt=.25,At=.01;async function Dt(e,n,t){let s=await createImageBitmap(e).catch(()=>null);if(s===null||Math.abs(s.width/s.height-2)>At){let c=s&&`is ${s.width} × ${s.height}; one of the whole sphere is twice as wide as high`;n.show(`${e.name}:`,`the picture ${c??"cannot be read"}. Nothing has changed.`);return}let a=Math.round(Math.min(s.width,Rt)/2),o=w("canvas",{width:2*a,height:a}),r=o.getContext("2d",{willReadFrequently:!0});r.drawImage(s,0,0,o.width,o.height),s.close(),n.close(),t(new Tt(e.name,r.getImageData(0,0,o.width,o.height)))}var Tt=class{name;#t;#e;letters={ink:"rgb(255, 255, 255)",accent:"rgb(245, 160, 98)",halo:"rgb(24 26 28 / 0.55)"};constructor(e,n){this.name=e,this.#t=new Et(n.data,n.width),this.#e=Mt(n)}draw(e,n,t,s){let a=s&&this.#e===null?Pt:Math.min(Lt,devicePixelRatio),o=Math.max(1,Math.ceil(2*n.r*a)),r=s&&this.#e!==null?this.#e(t,o):this.#n(t,o);e.within({region:c=>se(c,n)},()=>e.picture(r,n.x-n.r,n.y-n.r,2*n.r,2*n.r))}#n(e,n){let t=w("canvas",{width:n,height:n}),s=new ImageData(this.#t.painted(e,[-1,1,2/n,2/n],n,n,!1),n,n);return t.getContext("2d").putImageData(s,0,0),t}},Nt=`#version 300 es
out vec2 place;
void main() {
  place = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 4.0 - 1.0;
  gl_Position = vec4(place, 0.0, 1.0);
}`,Ot=`#version 300 es
precision highp float;
in vec2 place;
uniform sampler2D picture;
uniform mat3 left, right;
uniform float magnification;
out vec4 colour;
const float PI = 3.14159265358979;
void main() {
  float square = dot(place, place);
  vec3 seen = vec3(place, sqrt(max(0.0, 1.0 - square)));
  vec3 v = seen * left;
  float s = magnification, up = 1.0 + v.z, down = 1.0 - v.z;
  vec3 w = vec3(2.0 * s * v.xy, up - s * s * down) / (up + s * s * down) * right;
  vec2 at = vec2(atan(w.y, w.x) / (2.0 * PI) + 0.5, 0.5 - asin(clamp(w.z, -1.0, 1.0)) / PI);
  vec2 dx = dFdx(at), dy = dFdy(at);
  dx.x -= round(dx.x);
  dy.x -= round(dy.x);
  colour = square <= 1.02 ? textureGrad(picture, at, dx, dy) : vec4(0.0);
}`;function Mt(e){let n=w("canvas"),t=n.getContext("webgl2",{antialias:!1,depth:!1,alpha:!0});if(t===null||t.getParameter(t.MAX_TEXTURE_SIZE)<e.width)return null;let s=t.createProgram();for(let[a,o]of[[t.VERTEX_SHADER,Nt],[t.FRAGMENT_SHADER,Ot]]){let r=t.createShader(a);t.shaderSource(r,o),t.compileShader(r),t.attachShader(s,r)}return t.linkProgram(s),t.getProgramParameter(s,t.LINK_STATUS)?(t.useProgram(s),t.bindTexture(t.TEXTURE_2D,t.createTexture()),t.texImage2D(t.TEXTURE_2D,0,t.RGBA,t.RGBA,t.UNSIGNED_BYTE,e),t.generateMipmap(t.TEXTURE_2D),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_MIN_FILTER,t.LINEAR_MIPMAP_LINEAR),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_S,t.REPEAT),t.texParameteri(t.TEXTURE_2D,t.TEXTURE_WRAP_T,t.CLAMP_TO_EDGE),({left:a,right:o,magnification:r},c)=>{n.width!==c&&(n.width=n.height=c),t.viewport(0,0,c,c);for(let[i,{matrix:l}]of Object.entries({left:a,right:o}))t.uniformMatrix3fv(t.getUniformLocation(s,i),!0,new Float32Array(l));return t.uniform1f(t.getUniformLocation(s,"magnification"),1/r),t.drawArrays(t.TRIANGLES,0,3),n}):null}var G={ink:"ink",halo:"paper",size:24,align:"center"},fe={...G,ink:"ink-2",size:13};async function Le(e,n){let{width:t,paint:s,owner:a}=e;if(!a)return e;let o=ue(a.title,1.9*t/G.size),r=o.length*30+(o.length>0?6:0),c=new Image;if(a.legend){let h=a.legend.replace("<svg ",`<svg color="${n}" font-family='${N}' `);c.src=`data:image/svg+xml,${encodeURIComponent(h)}`,await c.decode()}let i=r+e.height+8,l=ue(a.source,2.1*t/fe.size),d=i+c.height;return{...e,title:a.title?`${a.title}. ${e.title}`:e.title,height:d+(l.length>0?l.length*17+10:0),paint(h){o.forEach((p,m)=>h.label(p,t/2,26+30*m,G)),h.within({corner:[0,r]},()=>s(h)),a.legend&&h.picture(c,(t-c.width)/2,i,c.width,c.height),l.forEach((p,m)=>h.label(p,t/2,d+14+17*m,fe))}}}function ue(e,n){let t=[];for(let s of e.split(/\s+/).filter(Boolean)){let a=t[t.length-1];a!==void 0&&a.length+s.length<n?t[t.length-1]=`${a} ${s}`:t.push(s)}return t}var It=`from dataclasses import replace

import numpy as np
from stereodel import SphereCircle, SphericalDelaunay, SphericalVoronoi, bubble_to_bubble, fisheye, lonlat_to_xyz
from stereodel.drawing import ColorScale, DotStyle, LineStyle, SizeScale, View, as_color
from stereodel.globe import Globe, Panel, panels
from stereodel.interpolation import contours
from stereodel.io import read_points

RED, WASH = LineStyle("#d55e00", 1.8), "#d55e0021"
radius = 1.349  # of circles of 150 km, degrees
[!bubble] focus = {focus}
[!bubble] lens = fisheye(focus, magnification={magnification})
[bubble] taken, filled = SphereCircle.around({taken}), SphereCircle.around({filled})
[bubble] lens = bubble_to_bubble(taken, filled)
[owned] table = {file}  # as the page exports it
[owned] places = table.lonlat
[!owned places] places = {places}
[scaled] values, scale = table.column({valued}), {scale}
[scaled isolines] net = SphericalDelaunay.from_lonlat(places{latitude})
[scaled isolines] levels = [tick for tick in scale.ticks if scale.low < tick < scale.high]
[scaled isolines] isolines = [line.lonlat for line in contours(net, values, levels)]
[scaled fills] shades = scale(values)
[owned !scaled] shades = {shades}


def earth():
    globe = Globe(ocean="#dde9f1", limb=LineStyle("#4d4d4d", 1.3){latitude}{title})
[picture]     globe.add_raster({picture})
[!picture land]     globe.add_land(color="#f4eddd", resolution="{resolution}")
[!picture land]     globe.add_coastlines(style=LineStyle("#405466", 0.7), resolution="{resolution}")
[owned fills]     globe.add_cells(SphericalVoronoi.from_lonlat(places{latitude}), colors=shades, style=None)
[owned fills !picture]     globe.add_coastlines(style=LineStyle("#405466", 0.7), resolution="{resolution}")
[graticule]     globe.add_graticule(10, style=LineStyle("#a9b5be", 0.5))
[tissot]     globe.add_tissot(10, radius, color="#40546629", style=LineStyle("#405466", 0.6))
[places cells]     cells = SphericalVoronoi.from_lonlat(places{latitude})
[places cells]     globe.add_cells(cells, style=LineStyle("#1b1b1b", 1.1))
[scaled isolines]     for style in (LineStyle("#fdfcfa", 2.4), LineStyle("#1b1b1b", 0.8)):
[scaled isolines]         globe.add_lines(isolines, style=style, name="isolines")
[owned]     globe.add_points(places, {points})
[places !owned]     globe.add_points(places, style=DotStyle("#1b1b1b", 2.5, "#fdfcfa", 0.6))
[pointed]     globe.add_circles([SphereCircle.around({pointer}, radius)], color=WASH, style=RED)
[named names]     globe.add_labels(places, {words}, size=13.0, movable=True)
    return globe


[!bubble] globe = earth()
[!bubble !owned] globe.add_points([focus], style=DotStyle("#fdfcfa", 5.9, RED.color, 1.8))
[!bubble !owned] globe.add_labels([focus], ["focus"], offset=(9.0, 7.0), color="#ab4300", font="italic", size=15.0)
[!bubble !owned] page = globe.page(lens, View({view}), width={width})
[!bubble owned] page = globe.page(lens, View({view}), width={width}, legend=True)
[bubble] before, after = earth(), earth()
[bubble] before.add_circles([taken], color=WASH, style=RED, name="rim")
[bubble] after.add_circles([taken], color=None, style=RED, name="rim")
[bubble] page = panels([Panel(before, None, View({before})), Panel(after, lens, View({view}))], width={width})
[bubble] page = replace(page, items=tuple(sorted(page.items, key=lambda item: item.name == "rim")))  # over the limb
replace(page.shaded(0.7), background=as_color("#fdfcfa")).save("globe.svg")
`,zt=`import numpy as np

from stereodel import PlanarDelaunay, PlanarVoronoi, SphereArc, SphereCircle, SphericalDelaunay, SphericalVoronoi, Stereographic, in_bubble
from stereodel.drawing import DotStyle, LineStyle, Polylines, Scene, Sketch, View

points = {points}
low, high = {corners}  # of the sheet
middle, diagonal = (low + high) / 2, np.hypot(*(high - low)) or 1.0
corners = np.array([low, [high[0], low[1]], high, [low[0], high[1]]])
sheet, view = PlanarDelaunay(points), View({view})
width, height, scale, contact = {width}, {height}, {scale}, np.array([{contact}])  # scale: of a diagonal
INK, GRAY, RED = LineStyle("#1b1b1b", 1.1), LineStyle("#7b7b7b", 0.9), LineStyle("#d55e00", 1.8)
HULL, SIDE, LIMB = LineStyle("#6d8598", 1.3), LineStyle("#7b7b7b", 1.3), LineStyle("#4d4d4d", 0.7)
PAPER, RAY, DOT = "#fdfcfa", LineStyle("#d55e00", 0.8, (5.0, 4.0)), DotStyle("#1b1b1b", 2.5, "#fdfcfa", 0.6)
sketch = Sketch()


def in_plane(xy):
    """Where places of the sheet are on the picture, before they are lifted."""
    uv = scale * (xy - middle) / diagonal
    return contact + view.project(np.concatenate([uv, 0 * uv[..., :1]], axis=-1))


[seeing facets] def hatch(chosen):
[seeing facets]     """Lines 45° steep, 6 points apart, where places of the picture are chosen."""
[seeing facets]     reach = np.hypot(width, height) / 2
[seeing facets]     along, across = np.arange(-reach, reach), np.arange(-reach, reach, 6.0)[:, None]
[seeing facets]     places = np.stack([along - across, along + across], axis=-1) / np.sqrt(2) + [width / 2, height / 2]
[seeing facets]     row, end = np.nonzero(np.diff(chosen(places), axis=1, prepend=False, append=False))
[seeing facets]     ends = places[row, np.minimum(end, len(along) - 1)].reshape(-1, 2, 2)
[seeing facets]     sketch.add_segments(ends, name="hatch", style=LineStyle("#9db0c0", 0.8))


[flat seeing facets] def outside(places):
[flat]     axes = np.linalg.inv(view.project(np.eye(3)[:2]))
[flat]     xy = (places - contact) @ axes * diagonal / scale + middle
[flat]     return ((low <= xy) & (xy <= high)).all(axis=-1) & (sheet.find_simplex(xy.reshape(-1, 2)).reshape(xy.shape[:2]) < 0)


[flat] sketch.add_polygon(in_plane(corners), name="sheet", color="#9db4c847")
[flat seeing facets] hatch(outside)
[flat seeing facets] sketch.add_edges(in_plane(points), sheet.convex_hull, name="hull", style=HULL)
[flat triangles] sketch.add_edges(in_plane(points), sheet.edges, name="delaunay", style=INK)
[flat cells facets] sketch.add_segments(in_plane(PlanarVoronoi(sheet).segments((*low, *high))[0]), name="voronoi", style=GRAY)
[flat] sketch.add_polyline(in_plane(corners), closed=True, name="side", style=SIDE)
[flat] images = in_plane(points)
[flat pair] sketch.add_segment(*images[[{pair}]], name="span", style=RED)
[flat] sketch.add_points(images, name="sites", style=DOT)
[!flat] radius = scale / (4 * np.tan(np.radians({corner}) / 2))
[!flat] projection, center = Stereographic((-90, 90), radius=radius), np.array([0.0, 0.0, -radius])


[!flat] def lifted(xy):
[!flat]     return projection.inverse(scale * (xy - middle) / diagonal)


[!flat] def outside(places):
[!flat]     axes = view.raised((places - contact - view.project(center)) / radius).reshape(-1, 3)
[!flat]     chosen, seen = np.zeros(len(axes), dtype=bool), np.isfinite(axes[:, 2])
[!flat]     xy = projection.forward(axes[seen] @ view.matrix) * diagonal / scale + middle
[!flat]     chosen[seen] = sheet.find_simplex(np.nan_to_num(xy, nan=1e300, posinf=1e300, neginf=-1e300)) < 0
[!flat]     return chosen.reshape(places.shape[:2])


[!flat] xyz = lifted(points)
[!flat] front, glass, span = (Scene(radius=radius, center=center, style=style, limb=LIMB) for style in ("solid", "glass", "none"))
[!flat seeing facets] uv = (points - middle) * 2.0 ** -np.round(np.log2(diagonal))  # rays that are exact
[!flat seeing facets] hull = SphericalDelaunay(np.column_stack([2 * uv, 1 - (uv**2).sum(axis=1)]))
[!flat seeing facets] closing = hull.simplices[in_bubble(*hull.points[hull.simplices].swapaxes(0, 1), (0, 0, -1)) >= 0]
[!flat seeing facets] front.add_edges(xyz, closing[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), name="hull", style=HULL)
[!flat] sketch.add_items(item for item in front.layout(view, at=contact) if item.name in {shown})
[!flat seeing facets] hatch(outside)
[!flat area] ends = np.stack([corners, np.roll(corners, -1, axis=0)], axis=1)
[!flat area] through = lifted(np.stack([ends[:, 0], ends.mean(axis=1), ends[:, 1]], axis=1))
[!flat area] sides = [SphereArc(SphereCircle.through(*three), three[0], three[2]) for three in through]
[!flat area] glass.add_region(sides, name="sheet", color="#9db4c847")
[!flat triangles] glass.add_edges(xyz, sheet.edges, name="delaunay", style=INK)
[!flat area] glass.add_arcs(sides, name="side", style=SIDE)
[!flat] sketch.add_items(item for item in glass.layout(view, at=contact) if item.name not in ("ball", "limb"))
[!flat cells facets] steps = np.stack([arc.sample(65) for arc in SphericalVoronoi(xyz).ridge_arcs()], axis=1)
[!flat cells facets] xy = projection.forward(steps) * diagonal / scale + middle
[!flat cells facets] inside = ((low <= xy) & (xy <= high)).all(axis=-1) & (view.depth(steps) >= 0)
[!flat cells facets] pieces = np.stack([steps[:-1], steps[1:]], axis=2)[inside[:-1] & inside[1:]].reshape(-1, 3)
[!flat cells facets] lines = contact + view.project(center + radius * pieces)
[!flat cells facets] sketch.add_items([Polylines(lines, np.arange(0, len(lines) + 1, 2), GRAY.color, GRAY.width, "voronoi")])
[!flat] images = contact + view.project(center + radius * xyz)
[!flat] sketch.add_points(images[view.depth(xyz) >= 0], name="sites", style=DOT)
[!flat] sketch.add_polygon(in_plane(corners), name="plane", color="#9db4c819")
[!flat] sketch.add_polyline(in_plane(corners), closed=True, name="frame", style=LIMB)
[!flat triangles] sketch.add_edges(in_plane(points), sheet.edges, name="flat", style=LineStyle("#1b1b1b61", 1.1))
[!flat] for arm in ([4.5, 0.0], [0.0, 3.5]):
[!flat]     sketch.add_segment(contact - arm, contact + arm, name="contact", style=LineStyle("#1b1b1b", 1.0))
[!flat pair] span.add_edges(xyz, [[{pair}]], name="span", style=RED)
[!flat pair] sketch.add_items(span.layout(view, at=contact))
[!flat pole] pole = contact + view.project(2 * center)
[letters] for site, letter in zip([{pair}], "PQ"):
[letters]     above = in_plane(points[site])
[!flat letters rays pole]     sketch.add_segment(pole, above, name="ray", style=RAY)
[!flat letters rays !pole]     sketch.add_segment(images[site], above, name="ray", style=RAY)
[letters !flat]     sketch.add_points(above, name="shadow", style=DotStyle(PAPER, 2.8, RED.color, 1.2))
[letters]     sketch.add_points(images[site], name="held", style=DotStyle(RED.color, 3.7, PAPER, 1.0))
[letters]     sketch.add_label(above, f"\${letter}$", (0.0, 9.0), valign="baseline", size=17.0, color="#ab4300")
[!flat pole] sketch.add_points(pole, name="pole", style=DotStyle("#1b1b1b", 2.3, PAPER, 0.6))
sketch.page((0, width, 0, height), width=width, background=PAPER).shaded(0.33).save("lift.svg")
`,jt=`import numpy as np

from stereodel import PlanarDelaunay, PlanarVoronoi, PlaneLine, SphereArc, SphereCircle, SphericalDelaunay, SphericalVoronoi, Stereographic, fisheye, in_bubble, lonlat_to_xyz
from stereodel.data import airports, cities, stars
from stereodel.drawing import DotStyle, Fill, LineStyle, Scene, Sketch, View, as_color
from stereodel.io import read_points
from stereodel.triangulation import planar_part

lonlat = {sites}
delaunay = SphericalDelaunay.from_lonlat(lonlat)
points, pole, view = delaunay.points, lonlat_to_xyz(({pole})), View({view})
[facets] sees_pole = in_bubble(*points[delaunay.simplices].swapaxes(0, 1), pole) >= 0
[facets] triangles = delaunay.simplices[~sees_pole]  # those of the plane
[facets] sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
[facets] edges, count = np.unique(sides, axis=0, return_counts=True)  # those of the hull are sides of one triangle

size, ball, gap = {size}, {ball}, {gap}  # of each picture, of the ball, between the pictures
left, right = np.array([0.5 * size, 0.5 * size]), np.array([1.5 * size + gap, 0.5 * size])
frame = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * (size / 2 - 1)
projection = Stereographic(-pole, radius=frame.max() / {reach})
shift = frame.max() / {reach} * np.array([{middle}])
flat = projection.forward(points) - shift
flat[(points == pole).all(axis=1)] = 1e9  # a site at the pole is far away
lens = fisheye({lens})
scene, sketch = Scene(limb=LineStyle("#4d4d4d", 1.3)), Sketch()
INK, GRAY, HULL = LineStyle("#1b1b1b", 1.1), LineStyle("#7b7b7b", 0.9), LineStyle("#6d8598", 1.3)
RED, WASH, PAPER = LineStyle("#d55e00", 1.8), "#d55e0021", "#fdfcfa"
DOT, HELD = DotStyle("#1b1b1b", 2.5, PAPER, 0.6), DotStyle(RED.color, 3.7, PAPER, 1.0)


def arcs(pairs):
    """Great circles between sites, through the lens."""
    return [lens.image_of(SphereArc.great(points[a], points[b])) for a, b in pairs]


def path(corners):
    return np.linspace(corners, np.roll(corners, -1, axis=0), 4, axis=1)


[hatched facets] along, across = np.arange(-size, size), np.arange(-size, size, 6.0)[:, None]
[hatched facets] steep = np.stack([along - across, along + across], axis=-1) / np.sqrt(2)  # lines, 6 points apart


[hatched facets] def hatch(middle, chosen, lines=steep):
[hatched facets]     """The parts of lines of a picture that are chosen."""
[hatched facets]     row, end = np.nonzero(np.diff(chosen(lines), axis=1, prepend=False, append=False))
[hatched facets]     ends = middle + lines[row, np.minimum(end, len(along) - 1)].reshape(-1, 2, 2)
[hatched facets]     sketch.add_segments(ends, name="hatch", style=LineStyle("#9db0c0", 0.8))


[hatched facets] def on_ball(facets, beyond):
[hatched facets]     """Chooses what lies on some facets, and beyond all triangles of the sphere or not."""
[hatched facets]     def chosen(places):
[hatched facets]         axes, found = view.raised(places / ball), np.zeros(places.shape[:2], dtype=bool)
[hatched facets]         seen = np.isfinite(axes[..., 2])
[hatched facets]         found[seen] = np.append(facets, beyond)[delaunay.find_simplex(lens.inverse()(axes[seen] @ view.matrix))]
[hatched facets]         return found
[hatched facets]     return chosen


[seeing facets] hull = PlanarDelaunay(flat[np.unique(triangles)])
[seeing facets] hatch(right, lambda places: hull.find_simplex(places.reshape(-1, 2)).reshape(places.shape[:2]) < 0)
[triangles facets] sketch.add_edges(right + flat, edges, name="delaunay", style=INK)
[triangles facets] scene.add_arcs(arcs(delaunay.edges), name="delaunay", style=INK)
[cells facets] ridges, _ = PlanarVoronoi(flat[np.unique(triangles)]).segments((-size, -size, size, size))
[cells facets] sketch.add_segments(right + ridges, name="voronoi", style=GRAY)
[cells] ridge_arcs = map(lens.image_of, SphericalVoronoi(delaunay).ridge_arcs())
[cells] scene.add_arcs(ridge_arcs, name="voronoi", style=GRAY)
[seeing facets] sketch.add_edges(right + flat, edges[count == 1], name="hull", style=HULL)
[seeing facets] scene.add_arcs(arcs(edges[count == 1]), name="hull", style=HULL)
[bubble aimed] triangle = delaunay.simplices[delaunay.find_simplex(lonlat_to_xyz(({aim})))]
[bubble aimed] bubble, pairs = SphereCircle.through(*points[triangle]), np.column_stack([triangle, np.roll(triangle, -1)])
[bubble aimed] scene.add_cap(lens.image_of(bubble), name="bubble", color=WASH)
[bubble aimed] scene.add_circles([lens.image_of(bubble)], style=RED)
[bubble aimed] scene.add_arcs(arcs(pairs), name="triangle", style=LineStyle(RED.color, 1.2))
[bubble aimed] image = projection.image_of(bubble)
[bubble aimed] if isinstance(image, PlaneLine):
[bubble aimed]     far = 9 * size * image.direction
[bubble aimed]     sketch.add_segment(right - shift + image.point - far, right - shift + image.point + far, name="circle", style=RED)
[bubble aimed] else:
[bubble aimed]     paths = [path(right - shift + image.sample(720))] + [path(right + frame)] * image.outside
[bubble aimed]     sketch.add_items([Fill(tuple(paths), as_color(WASH), "bubble")])
[bubble aimed]     sketch.add_circle(right - shift + image.center, image.radius, name="circle", style=RED)
[bubble aimed]     if not image.outside:
[bubble aimed]         sketch.add_edges(right + flat, pairs, name="triangle", style=LineStyle(RED.color, 1.2))
[step] before, new = SphericalDelaunay(points[: {step} - 1]), {step} - 1
[step] opened = before.simplices[in_bubble(*points[before.simplices].swapaxes(0, 1), points[new]) > 0]
[step] sides = opened[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2).tolist()
[step] fan = np.array([[a, b, new] for a, b in sides if [b, a] not in sides], dtype=int).reshape(-1, 3)
[step] flat_fan = fan[in_bubble(*points[fan].swapaxes(0, 1), pole) < 0]
[step] for corners in opened[np.linalg.det(points[opened]) > 0].tolist():  # others close the hull
[step]     scene.add_region(arcs(zip(corners, corners[1:] + corners[:1])), name="opened", color=WASH)
[step] for corners in flat_fan:
[step]     sketch.add_polygon(right + flat[corners], name="opened", color=WASH)
[step] planar = planar_part(before, pole)[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)
[step] scene.add_arcs(arcs(before.edges), name="delaunay", style=INK)
[step] sketch.add_edges(right + flat, np.unique(np.sort(planar, axis=1), axis=0), name="delaunay", style=INK)
[step] scene.add_arcs(arcs(fan[:, [2, 0]]), name="fan", style=LineStyle(RED.color, 1.0, (4.0, 3.0)))
[step] spokes = np.unique(flat_fan[:, [2, 0, 2, 1]].reshape(-1, 2), axis=0)
[step] sketch.add_edges(right + flat, spokes, name="fan", style=LineStyle(RED.color, 1.0, (4.0, 3.0)))
[step] scene.add_arcs(arcs(fan[:, :2]), name="horizon", style=RED)
[step] sketch.add_edges(right + flat, flat_fan[:, :2], name="horizon", style=RED)
sketch.add_points((right + flat)[:{step}], name="sites", style=DOT)
scene.add_points(lens(points)[:{step}], name="sites", style=DOT)
[held] sketch.add_points((right + flat)[[{held}]], name="held", style=HELD)
[held] scene.add_points(lens(points)[[{held}]], name="held", style=HELD)
around = Fill((path(right + 9 * frame), path(right + frame)), as_color(PAPER), "paper")
sketch.add_items([around]).add_polyline(right + frame, closed=True, name="frame", style=LineStyle("#4d4d4d", 0.7))
ground, *items = scene.layout(view, at=left, scale=ball)
sketch.add_items([ground])
[seeing facets] hatch(left, on_ball(sees_pole, (sees_pole & delaunay.closing).any()))
[closing hemisphere] for lines in (steep, steep * [1, -1]):
[closing hemisphere]     hatch(left, on_ball(delaunay.closing, True), lines)
sketch.add_items(items)
[pole] at = left + ball * view.project(lens(pole))
[pole front] sketch.add_points(at, name="pole", style=DotStyle(PAPER, 5.9, RED.color, 1.8))
[pole !front] sketch.add_circle(at, 5.0, name="pole", style=LineStyle(RED.color, 1.2))
[pole] sketch.add_label(at, "$P$", (11.0 if at[0] < left[0] else -11.0, 0.0), size=15.0, color="#ab4300")
page = sketch.page((0, 2 * size + gap, 0, size), width=2 * size + gap, background=PAPER)
page.shaded(0.33).save("sphere.svg")
`,Pe=200,Ae="cities().lonlat[cities().population >= 2_000_000]",Ct=`SphericalDelaunay.from_lonlat(airports().lonlat).nearest(lonlat=${Ae})`,Ft={cities:Ae,airports:`airports().lonlat[np.unique(${Ct})]`,stars:"stars().lonlat[stars().magnitude <= 3.0]"};function Ut(e,n,t,s,a){let{sites:o,view:r,bubble:c,aim:i,step:l}=e,d=f=>l===null&&e.isOn(f),h=[...d("bubble")&&c?.sites||[],...l===null?e.held:[l.site]],p={facets:o.facetCount>0,hemisphere:o.hasClosing,step:l!==null&&l.before.length>0,aimed:c!==null,held:h.length>0,pole:t!==null,front:t!==null&&t[2]>=0,hatched:d("seeing")||d("closing")&&o.hasClosing},m={...a,sites:Ft[s.set]??q(o.lonlat,`${De(s.file)}.lonlat`),pole:_(n.pole),view:_(r.middle),aim:L(i).join(", "),lens:`(${_(L(n.lens.focus))}), magnification=${n.lens.magnification}`,held:h.join(", "),step:l===null?"":l.site+1};return V(jt,m,p,d)}function Ht(e,n,t,s){let{sites:a,sheet:o,view:r,isOn:c}=e,[i,l]=[e.p,e.q].filter(u=>u!==null),{contact:d,height:h}=n,p=a.count===0?[3,2]:s,m={facets:a.delaunay.dimension===2,flat:o.isFlat,area:a.rectangle.width>0&&a.rectangle.height>0,letters:i!==void 0,pair:l!==void 0&&i!==l,pole:n.seenPole!==null},f={points:q(a.places,`np.loadtxt(${JSON.stringify(t.file)}, delimiter=",", skiprows=1, usecols=(0, 1))`),corners:p?`np.array([[-1, -1], [1, 1]]) * [${_(p)}] / 2`:"points.min(axis=0), points.max(axis=0)",view:_(r.middle),width:n.width,height:h,scale:n.scale,contact:`${d[0]}, ${h-d[1]}`,corner:o.corner,pair:[i,l].join(", "),shown:JSON.stringify(n.grounds)};return V(zt,f,m,c)}function Wt(e,n,t,s,a){let{lens:o,sight:r,from:c,to:i,before:l,after:d,pointer:h}=e,{places:p,latitude:m,picture:f,resolution:u}=n,b=o==="bubble",{owner:y,names:A,lonlat:B=new Float64Array(0)}=p??{},z=De(p?.name??""),j=p===null||m==="spherical"?"":`, latitude="${m}"`,D=C=>{let T=`(${_(L(C))})`;return j===""?T:`lonlat_to_xyz(${T}${j})`},Y=({middle:C,roll:T})=>_([...C,T]).replace(/, -?0$/,""),Te={focus:D(r.lens.focus),magnification:_([r.lens.magnification]),taken:`${D(c.center)}, ${_([c.radius])}`,filled:`${D(i.center)}, ${_([i.radius])}`,title:"",...y?.lines,file:z,places:q(B,`${z}.lonlat`),words:B.length>2*Pe?`${z}.column("name")`:JSON.stringify(A),latitude:j,picture:JSON.stringify(f?.name??""),resolution:u,pointer:D(h),before:Y(l),view:Y(b?d:r.view),width:_([1.03*s*(b?2:1)])},{points:Ne,scale:Oe}=y?.lines??{};return V(It,Te,{bubble:b,picture:f,places:p,pointed:a,owned:Ne,scaled:Oe,named:A},t)}function V(e,n,t,s){let a=l=>l in t?!!t[l]:s(l),r=e.split(`
`).flatMap(l=>{let[,d,h]=/^(?:\[([!a-z ]+)\] )?(.*)$/.exec(l);return d?.split(" ").every(m=>m.startsWith("!")?!a(m.slice(1)):a(m))===!1?[]:[h]}).join(`
`).replace(/\{(\w+)\}/g,(l,d)=>String(n[d]??l)),c=r.replace(/^(from|import) .*\n/gm,""),i=l=>new RegExp(`\\b${l.split(" as ").pop()}\\b`).test(c);return r.replace(/^((?:from \S+ )?import )(.*)\n/gm,(l,d,h)=>{let p=h.split(", ").filter(i);return p.length===0?"":`${d}${p.join(", ")}
`})}function q(e,n){if(e.length>2*Pe)return n;let t=Array.from({length:e.length/2},(a,o)=>`[${e[2*o]}, ${e[2*o+1]}]`),s=t.join(", ").replace(/(.{1,82}\],) /g,`$1
    `);return t.length===0?"np.zeros((0, 2))":`np.array([
    ${s},
])`}var De=e=>`read_points(${JSON.stringify(e)})`;function _(e){return e.map(n=>O(n,7)).join(", ")}async function Gt(e,n){let t=e.cloneNode(!0);t.querySelector("#block-state")?.remove();let s=w("script",{type:"text/plain",id:"block-state"},await Vt(n));return t.querySelector("#block-kernel").before(s,`
`),new Blob([`<!doctype html>
`,t.outerHTML,`
`],{type:"text/html"})}async function Vt(e){let n=new Blob([e]).stream().pipeThrough(new CompressionStream("deflate")),t=new Uint8Array(await new Response(n).arrayBuffer());return btoa(Array.from(t,s=>String.fromCharCode(s)).join(""))}function qt(e,n){let t=new Blob([n]),s=w("a",{href:URL.createObjectURL(t),download:e});s.click(),setTimeout(()=>URL.revokeObjectURL(s.href),6e4)}async function Bt(e){let{title:n,width:t,height:s,paint:a}=await Le(e,R().ink),o=new ze(t,s,R());return a(o),o.text(n)}async function Yt(e,n){let{width:t,height:s,paint:a}=await Le(e,R().ink),o=w("canvas",{width:Math.round(t*n),height:Math.round(s*n)}),r=o.getContext("2d");return r.fillStyle=R().paper,r.fillRect(0,0,o.width,o.height),a(new K(r,t,s,n,R())),new Promise((c,i)=>{o.toBlob(l=>l===null?i(new Error("the picture is too large")):c(l))})}var Xt={csv:ct,download:qt,geojson:wt,globePython:Wt,liftPython:Ht,openPanorama:Dt,openPoints:ke,savedPage:Gt,sheetPng:Yt,sheetSvg:Bt,spherePython:Ut};Object.assign(document.currentScript,{offers:Xt});})();
